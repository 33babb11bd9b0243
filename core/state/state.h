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

}  // namespace flexcast
