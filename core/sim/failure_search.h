// Whether a state may leave the engine, and if not, where the trouble is.
#pragma once

#include "core/forces/model.h"
#include "core/sim/report.h"
#include "core/state/state.h"

namespace flexcast {

// Metres or metres per second: beyond it a number is lost in single precision, which most streams use.
inline constexpr double largest_magnitude = 1e38;

// All positions and velocities are finite and at most largest_magnitude.
bool is_publishable(const State& state);

// The first particle with something wrong (else the one that moves fastest), the first element at it, and what it is.
// `before` is the last good state.
Failure find_failure(const Model& model, const State& before, const State& after);

}  // namespace flexcast
