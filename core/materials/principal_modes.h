// The tangent of an isotropic law in principal axes. With F = U diag(s) V^T and p_i = dPsi/ds_i its nine eigenmodes are
//   three of scaling, U diag(w) V^T, w and eigenvalue those of the 3 x 3 matrix d2Psi / (ds_i ds_j),
//   three of twist, (u_i v_j^T - u_j v_i^T) / sqrt(2), eigenvalue (p_i + p_j) / (s_i + s_j),
//   three of flip, (u_i v_j^T + u_j v_i^T) / sqrt(2), eigenvalue (p_i - p_j) / (s_i - s_j).
// Source: B. Smith, F. de Goes, T. Kim, Analytic eigensystems for isotropic distortion energies, ACM TOG 38(1), 2019.
#pragma once

#include "core/base/math.h"

namespace flexcast {

// F = U diag(s) V^T with det U = det V: an inverted F has one negative stretch.
struct PrincipalStretches {
  Mat3 U;
  Vec3 s;
  Mat3 V;
};

PrincipalStretches calc_principal_stretches(const Mat3& F);

// Eigenvalues in Pa. Entry k of twist and flip belongs to the axes other than k.
struct PrincipalModes {
  Mat3 scaling;
  Vec3 twist;
  Vec3 flip;
};

// Raises the negative eigenvalues of the exact tangent to zero and leaves the others: the nearest positive
// semidefinite matrix in the Frobenius norm.
void clamp_negative_modes(const PrincipalStretches& stretches, const PrincipalModes& modes, Mat9& dPdF);

}  // namespace flexcast
