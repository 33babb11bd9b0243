#include "core/materials/st_venant_kirchhoff.h"

#include "core/materials/principal_modes.h"
#include "core/materials/small_strain.h"

namespace flexcast {
namespace {

Mat3 calc_green_strain(const Mat3& F) {
  return 0.5 * (F.transpose() * F - Mat3::Identity());
}

void calc_energy(Lame lame, std::span<const Mat3> F, std::span<double> Psi) {
  for (std::size_t i = 0; i < F.size(); ++i) Psi[i] = calc_hooke_energy(lame, calc_green_strain(F[i]));
}

void calc_stress(Lame lame, std::span<const Mat3> F, std::span<Mat3> P) {
  for (std::size_t i = 0; i < F.size(); ++i) P[i] = F[i] * calc_hooke_stress(lame, calc_green_strain(F[i]));
}

// With S = 2 mu e + lambda tr(e) I and the columns f_j of F, the block dP_j / dF_l of columns j and l is
//   delta_jl mu F F^T + S_jl I + mu f_l f_j^T + lambda f_j f_l^T.
Mat9 calc_exact_tangent(Lame lame, const Mat3& F) {
  const Mat3 S = calc_hooke_stress(lame, calc_green_strain(F));
  Mat9 tangent;
  for (Eigen::Index j = 0; j < 3; ++j) {
    for (Eigen::Index l = 0; l < 3; ++l) {
      Mat3 block = lame.mu * F.col(l) * F.col(j).transpose() + lame.lambda * F.col(j) * F.col(l).transpose();
      block.diagonal().array() += S(j, l);
      tangent.block<3, 3>(3 * j, 3 * l) = block;
    }
  }
  const Mat3 B = lame.mu * F * F.transpose();
  for (Eigen::Index j = 0; j < 3; ++j) tangent.block<3, 3>(3 * j, 3 * j) += B;
  return tangent;
}

// p_i = s_i (mu (s_i^2 - 1) + lambda tr(e)): the quotients of the twist and flip modes divide out.
PrincipalModes calc_modes(Lame lame, const Vec3& s) {
  const double pressure = 0.5 * lame.lambda * (s.squaredNorm() - 3.0) - lame.mu;
  PrincipalModes modes;
  modes.scaling = lame.lambda * s * s.transpose();
  for (int k = 0; k < 3; ++k) {
    const double a = s[(k + 1) % 3], b = s[(k + 2) % 3];
    modes.scaling(k, k) += pressure + 3.0 * lame.mu * s[k] * s[k];
    modes.twist[k] = pressure + lame.mu * (a * a - a * b + b * b);
    modes.flip[k] = pressure + lame.mu * (a * a + a * b + b * b);
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

const Law st_venant_kirchhoff_law{"st_venant_kirchhoff",
                                  "Green strain; large turns, small strains: collapses under strong compression",
                                  false,
                                  calc_energy,
                                  calc_stress,
                                  calc_tangent,
                                  LawKernel::st_venant_kirchhoff};

}  // namespace flexcast
