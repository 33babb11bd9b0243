// How fast the modes of a body can be.
#pragma once

#include <vector>

#include "core/forces/system.h"

namespace flexcast {

// 1/s^2, by a body.
struct LargestMode {
  double elastic = 0.0;        // omega^2 of what is elastic inside the body
  double omega_squared = 0.0;  // with what touches and pulls it
};

// One per body, of all active forces. The bounds of the elements, which no mode passes at rest, cap the result where
// they hold.
std::vector<LargestMode> calc_largest_modes(const System& system, const Model& model, const VecX& x);

}  // namespace flexcast
