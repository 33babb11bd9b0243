// The springs of a body.
#pragma once

#include <memory>

#include "core/forces/force.h"

namespace flexcast {
void make_springs(const Model& model, std::vector<std::unique_ptr<Force>>& forces);
}
