// Weight: f = m g on every particle, energy -sum m g.x.
#pragma once

#include <memory>

#include "core/forces/force.h"

namespace flexcast {
void make_gravity(const Model& model, std::vector<std::unique_ptr<Force>>& forces);
}
