#include "core/materials/principal_modes.h"

#include <Eigen/Eigenvalues>

#include "core/materials/polar.h"

namespace flexcast {
namespace {

// dPdF -= eigenvalue mode mode^T.
void remove_mode(double eigenvalue, const Mat3& mode, Mat9& dPdF) {
  const Eigen::Matrix<double, 9, 1> q = mode.reshaped();
  dPdF.noalias() -= eigenvalue * q * q.transpose();
}

// Sylvester's criterion: cheaper than the eigenvalues, and true for most elements of most bodies.
bool is_positive_definite(const Mat3& A) {
  return A(0, 0) > 0.0 && A(0, 0) * A(1, 1) > A(0, 1) * A(1, 0) && A.determinant() > 0.0;
}

}  // namespace

PrincipalStretches calc_principal_stretches(const Mat3& F) {
  const Polar polar = calc_polar(F);
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(polar.S);
  return {polar.Q * eigen.eigenvectors(), eigen.eigenvalues(), eigen.eigenvectors()};
}

void clamp_negative_modes(const PrincipalStretches& stretches, const PrincipalModes& modes, Mat9& dPdF) {
  const auto& [U, s, V] = stretches;
  for (int k = 0; k < 3; ++k) {
    if (modes.twist[k] >= 0.0 && modes.flip[k] >= 0.0) continue;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Mat3 ij = U.col(i) * V.col(j).transpose(), ji = U.col(j) * V.col(i).transpose();
    if (modes.twist[k] < 0.0) remove_mode(0.5 * modes.twist[k], ij - ji, dPdF);
    if (modes.flip[k] < 0.0) remove_mode(0.5 * modes.flip[k], ij + ji, dPdF);
  }
  if (is_positive_definite(modes.scaling)) return;
  const Eigen::SelfAdjointEigenSolver<Mat3> scaling(modes.scaling);
  for (int k = 0; k < 3; ++k) {
    if (scaling.eigenvalues()[k] >= 0.0) break;  // in increasing order
    remove_mode(scaling.eigenvalues()[k], U * scaling.eigenvectors().col(k).asDiagonal() * V.transpose(), dPdF);
  }
}

}  // namespace flexcast
