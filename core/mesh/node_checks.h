// What the nodes of every mesh file must satisfy.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/base/result.h"

namespace flexcast {

// Coordinates are finite, and no two nodes lie at the same place. `number`: the file's own, for the text.
Result<void> check_node_places(const std::string& file, const std::vector<Vec3>& nodes,
                               const std::function<std::string(std::size_t node)>& number);

}  // namespace flexcast
