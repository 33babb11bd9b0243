// Selectors: reading them, and which particles they select.
#pragma once

#include <vector>

#include "core/scene/description.h"
#include "core/scene/table_reader.h"

namespace flexcast {

// { box = [[lo], [hi]] } | { sphere = [x, y, z, r] } | { nodes = [0, 5] } | { all = true }
Selector read_selector(const TableEntry& entry);

// World numbers of the body's selected particles, rising, each once. Refuses a node the body does not have and a
// selector that selects nothing.
std::vector<std::int32_t> select(const Selector& selector, const std::vector<Vec3>& rest_positions,
                                 IndexRange particles);

}  // namespace flexcast
