// The equilibrium of a scene: what `flexcast-lab run --static` prints.
#pragma once

#include <atomic>

#include "core/sim/simulation.h"

namespace flexcast {

struct StaticOptions {
  int most_steps = 200;                     // quasi-static steps, after the handles have arrived
  const std::atomic<bool>* stop = nullptr;  // ends the search early when it becomes true
};

// Takes quasi-static steps, at least one: first the handles move from their start to their end in increments small
// against the body, then steps go on until one converges to the scene's solver.newton_tolerance (they aim far below
// it, and end where rounding does). False: none did; the state is the last one. Changes time.integrator, time.step,
// solver settings and the handles' start and duration.
bool solve_static(Simulation& simulation, const StaticOptions& options = {});

}  // namespace flexcast
