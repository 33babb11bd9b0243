// Grabbed particles: each is pulled to its target by a spring of rest length 0, f = k (target - x), booked as external
// work.
#pragma once

#include <memory>

#include "core/forces/force.h"

namespace flexcast {
void make_grabs(const Model& model, std::vector<std::unique_ptr<Force>>& forces);
}
