// The springs of a body for vertex block descent: each is stored once for each end.
#pragma once

#include <memory>

#include "core/forces/block_runs.h"
#include "core/forces/model.h"

namespace flexcast {
std::unique_ptr<BlockRuns> make_spring_runs(const Model& model, const Body& body, const Visits& visits);
}
