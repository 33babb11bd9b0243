// Dead loads: forces that keep their direction and size, N on single particles.
#pragma once

#include <memory>

#include "core/forces/force.h"

namespace flexcast {
void make_dead_load(const Model& model, std::vector<std::unique_ptr<Force>>& forces);
}
