// Where the trouble is when a state must not leave the engine.
#pragma once

#include "core/forces/model.h"
#include "core/sim/report.h"
#include "core/state/state.h"

namespace flexcast {

// The first particle with something wrong (else the one that moves fastest), the first element at it, and what it is.
// `before` is the last good state.
Failure find_failure(const Model& model, const State& before, const State& after);

}  // namespace flexcast
