#include "core/materials/corotational.h"

#include <Eigen/Eigenvalues>

#include "core/materials/polar.h"
#include "core/materials/small_strain.h"
#include "core/materials/tensors.h"

namespace flexcast {
namespace {

// Below this sum of two signed singular values the rotation turns so fast that its derivative is clamped (F has no
// unit, so the bound needs none).
constexpr double smallest_pair_sum = 1e-8;

void calc_energy(Lame lame, std::span<const Mat3> F, std::span<double> Psi) {
  for (std::size_t i = 0; i < F.size(); ++i) Psi[i] = calc_hooke_energy(lame, calc_polar(F[i]).S - Mat3::Identity());
}

void calc_stress(Lame lame, std::span<const Mat3> F, std::span<Mat3> P) {
  for (std::size_t i = 0; i < F.size(); ++i) {
    const Polar polar = calc_polar(F[i]);
    P[i] = polar.Q * calc_hooke_stress(lame, polar.S - Mat3::Identity());
  }
}

// dP = 2 mu dF + lambda (Q:dF) Q + (lambda tr(e) - 2 mu) dQ, and dQ = sum_k (T_k:dF) T_k / g_k over the twist modes
// T_k = Q [n_k], n_k the eigenvectors of S and g_k = tr(S) - s_k. The three modes have |T_k|^2 = 2 and are orthogonal
// to each other and to Q, so the eigenvalue 2 mu + 2 c_k is made non-negative by c_k >= -mu.
Mat9 calc_tangent_of(Lame lame, Tangent kind, const Mat3& F) {
  const Polar polar = calc_polar(F);
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(polar.S);

  Mat9 tangent = 2.0 * lame.mu * Mat9::Identity();
  const Eigen::Matrix<double, 9, 1> q = polar.Q.reshaped();
  tangent += lame.lambda * q * q.transpose();
  for (int k = 0; k < 3; ++k) {
    const Mat3 T = polar.Q * make_cross_matrix(eigen.eigenvectors().col(k));
    const Eigen::Matrix<double, 9, 1> t = T.reshaped();
    const bool clamped = kind == Tangent::positive_semidefinite;
    tangent += calc_twist(lame, clamped, eigen.eigenvalues(), k) * t * t.transpose();
  }
  return tangent;
}

void calc_tangent(Lame lame, Tangent kind, std::span<const Mat3> F, std::span<Mat9> dPdF) {
  for (std::size_t i = 0; i < F.size(); ++i) dPdF[i] = calc_tangent_of(lame, kind, F[i]);
}

}  // namespace

double calc_twist(Lame lame, bool clamped, const Vec3& s, int k) {
  const double factor = lame.lambda * (s.sum() - 3.0) - 2.0 * lame.mu;
  const double c = factor / std::max(s.sum() - s[k], smallest_pair_sum);
  return clamped ? std::max(c, -lame.mu) : c;
}

const Law corotational_law{"corotational",
                           "strain in the turned frame of each element, exact rotation",
                           false,
                           calc_energy,
                           calc_stress,
                           calc_tangent,
                           LawKernel::corotational};

}  // namespace flexcast
