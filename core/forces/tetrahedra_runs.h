// The tetrahedra of a body for vertex block descent: each is stored once for each of its nodes, 92 bytes with four
// nodes, 116 with ten.
#pragma once

#include <memory>

#include "core/forces/block_runs.h"
#include "core/forces/model.h"

namespace flexcast {
std::unique_ptr<BlockRuns> make_tetrahedra_runs(const Model& model, const Body& body, const Visits& visits);
}
