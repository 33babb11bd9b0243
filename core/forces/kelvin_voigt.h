// Kelvin-Voigt damping: the stress F (lambda tr(E') I + 2 mu E') with E' = sym(F^T F'), the rate of the Green strain;
// for small strain, lambda tr(e') I + 2 mu e' with e' = sym F'. The viscosities lambda and mu are in Pa.s.
// Source: T. Belytschko, W. K. Liu, B. Moran, Nonlinear Finite Elements for Continua and Structures, chapter 5.
#pragma once

#include "core/materials/law.h"

namespace flexcast {

inline Mat3 calc_kelvin_voigt_stress(Lame viscosity, bool small_strain, const Mat3& F, const Mat3& rate) {
  const Mat3 G = small_strain ? rate : Mat3(F.transpose() * rate);
  const Mat3 strain_rate = 0.5 * (G + G.transpose());
  const Mat3 S = 2.0 * viscosity.mu * strain_rate + viscosity.lambda * strain_rate.trace() * Mat3::Identity();
  return small_strain ? S : Mat3(F * S);
}

// Its slope with respect to F', laid out as Law::calc_tangent does.
inline Mat9 calc_kelvin_voigt_tangent(Lame viscosity, bool small_strain, const Mat3& F) {
  Mat9 C;
  for (int l = 0; l < 3; ++l) {
    for (int k = 0; k < 3; ++k) {
      const Mat3 unit = Vec3::Unit(k) * Vec3::Unit(l).transpose();
      C.col(k + 3 * l) = calc_kelvin_voigt_stress(viscosity, small_strain, F, unit).reshaped();
    }
  }
  return C;
}

}  // namespace flexcast
