// Hooke's law for a strain e: shared by the laws that differ only in what they take as strain.
#pragma once

#include "core/materials/law.h"

namespace flexcast {

inline double calc_hooke_energy(Lame lame, const Mat3& e) {
  const double trace = e.trace();
  return lame.mu * e.squaredNorm() + 0.5 * lame.lambda * trace * trace;
}

inline Mat3 calc_hooke_stress(Lame lame, const Mat3& e) {
  return 2.0 * lame.mu * e + lame.lambda * e.trace() * Mat3::Identity();
}

}  // namespace flexcast
