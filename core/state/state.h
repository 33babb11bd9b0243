// What changes from step to step.
#pragma once

#include "core/base/math.h"

namespace flexcast {

struct State {
  VecX positions;         // m, 3 n
  VecX velocities;        // m/s, 3 n
  std::int64_t step = 0;  // completed steps
  double time = 0.0;      // s
};

// Metres or metres per second: beyond it a number is lost in single precision, which most streams use.
inline constexpr double largest_magnitude = 1e38;

// All positions and velocities are finite and at most largest_magnitude.
bool is_publishable(const State& state);

}  // namespace flexcast
