// What a simulation may be asked beside its steps, as things to be timed: reports, probes, what goes into a frame.
#pragma once

#include <vector>

#include "core/lab/cost/scene_cost.h"
#include "core/sim/simulation.h"

namespace flexcast {

// Of the present state, medians of repeats that take turns. A field's cost is what it adds to a frame that has nothing
// but its bounds.
std::vector<ExtraCost> measure_extras(const Simulation& simulation);

}  // namespace flexcast
