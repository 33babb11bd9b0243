// Damping against the resting world: mass-proportional, -alpha m v, and drag, -c v on every particle of a body.
#pragma once

#include <memory>

#include "core/forces/force.h"

namespace flexcast {
void make_drag(const Model& model, std::vector<std::unique_ptr<Force>>& forces);
}
