#include "core/materials/neo_hookean.h"

#include <cmath>

#include "core/materials/principal_modes.h"
#include "core/materials/tensors.h"

namespace flexcast {
namespace {

// All below is written with t = tr(e) = (Ic - 3)/2 of the Green strain e and j = J - 1, both 0 at rest. As m = 4 mu/3
// and l (J - a) = l j - mu, nothing divides by l:
//   Psi = mu (t - j) + 2 mu/3 (t/2 - ln(1 + t/2)) + l/2 j^2,
//   P = mu (1 + t/(3 (t + 2))) F + (l j - mu) cof F,  t + 2 >= 1/2.
double calc_l(Lame lame) {
  return lame.lambda + 5.0 / 6.0 * lame.mu;
}

// The factor of F in P.
double calc_factor(Lame lame, double t) {
  return lame.mu * (1.0 + t / (3.0 * (t + 2.0)));
}

// t - j is of second order. det(I + 2 e) = J^2 gives it without the cancellation that would drown small strains:
// t - j = j^2/2 - (t^2 - e:e) - 4 det(e). For large ones that formula would be the worse.
double calc_distortion(const Mat3& e, double t, double j) {
  const double square = e.squaredNorm();
  return square < 1.0 ? 0.5 * j * j - t * t + square - 4.0 * e.determinant() : t - j;
}

double calc_energy_of(Lame lame, const Mat3& F) {
  const Mat3 e = 0.5 * (F.transpose() * F - Mat3::Identity());
  const double t = e.trace(), j = F.determinant() - 1.0;
  const double logarithmic = 0.5 * t - std::log1p(0.5 * t);
  return lame.mu * (calc_distortion(e, t, j) + 2.0 / 3.0 * logarithmic) + 0.5 * calc_l(lame) * j * j;
}

void calc_energy(Lame lame, std::span<const Mat3> F, std::span<double> Psi) {
  for (std::size_t i = 0; i < F.size(); ++i) Psi[i] = calc_energy_of(lame, F[i]);
}

void calc_stress(Lame lame, std::span<const Mat3> F, std::span<Mat3> P) {
  const double l = calc_l(lame);
  for (std::size_t i = 0; i < F.size(); ++i) {
    const Mat3 cofactor = calc_cofactor(F[i]);
    const double t = 0.5 * (F[i].squaredNorm() - 3.0), j = F[i].col(0).dot(cofactor.col(0)) - 1.0;
    P[i] = calc_factor(lame, t) * F[i] + (l * j - lame.mu) * cofactor;
  }
}

// dP = factor dF + 2 mu/(3 (t + 2)^2) (F:dF) F + l (cof F:dF) cof F + (l j - mu) d(cof F), the last being cross
// products of the columns: col 0 of cof F is f_1 x f_2, and so on in a circle.
Mat9 calc_exact_tangent(Lame lame, const Mat3& F) {
  const double l = calc_l(lame);
  const Mat3 cofactor = calc_cofactor(F);
  const double t = 0.5 * (F.squaredNorm() - 3.0), j = F.col(0).dot(cofactor.col(0)) - 1.0;
  const Eigen::Matrix<double, 9, 1> f = F.reshaped(), g = cofactor.reshaped();
  Mat9 tangent = (2.0 * lame.mu / (3.0 * (t + 2.0) * (t + 2.0)) * f) * f.transpose();
  tangent.noalias() += (l * g) * g.transpose();
  tangent.diagonal().array() += calc_factor(lame, t);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Index a = (k + 1) % 3, b = (k + 2) % 3;
    const Mat3 cross = (l * j - lame.mu) * make_cross_matrix(F.col(k));
    tangent.block<3, 3>(3 * a, 3 * b) -= cross;
    tangent.block<3, 3>(3 * b, 3 * a) += cross;
  }
  return tangent;
}

PrincipalModes calc_modes(Lame lame, const Vec3& s) {
  const double l = calc_l(lame);
  const double t = 0.5 * (s.squaredNorm() - 3.0), j = s.prod() - 1.0;
  const double factor = calc_factor(lame, t), pressure = l * j - lame.mu;
  const Vec3 g(s[1] * s[2], s[2] * s[0], s[0] * s[1]);
  PrincipalModes modes;
  modes.scaling = 2.0 * lame.mu / (3.0 * (t + 2.0) * (t + 2.0)) * s * s.transpose() + l * g * g.transpose();
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    modes.scaling(k, k) += factor;
    modes.scaling(a, b) += pressure * s[k];
    modes.scaling(b, a) += pressure * s[k];
    modes.twist[k] = factor + pressure * s[k];
    modes.flip[k] = factor - pressure * s[k];
  }
  return modes;
}

void calc_tangent(Lame lame, Tangent kind, std::span<const Mat3> F, std::span<Mat9> dPdF) {
  for (std::size_t i = 0; i < F.size(); ++i) {
    dPdF[i] = calc_exact_tangent(lame, F[i]);
    if (kind == Tangent::exact) continue;
    const PrincipalStretches stretches = calc_principal_stretches(F[i]);
    clamp_negative_modes(stretches, calc_modes(lame, stretches.s), dPdF[i]);
  }
}

}  // namespace

const Law neo_hookean_law{"neo_hookean",
                          "stable neo-Hookean: large strains, recovers from inversion",
                          false,
                          calc_energy,
                          calc_stress,
                          calc_tangent,
                          LawKernel::neo_hookean};

}  // namespace flexcast
