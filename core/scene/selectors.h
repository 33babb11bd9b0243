// Selectors: reading them, and which particles they select.
#pragma once

#include <span>
#include <vector>

#include "core/scene/description.h"
#include "core/scene/table_reader.h"

namespace flexcast {

// { box = [[lo], [hi]] } | { sphere = [x, y, z, r] } | { nodes = [0, 5] } | { all = true }
Selector read_selector(const TableEntry& entry);

// World numbers of the body's selected particles, rising, each once. Refuses a node the body does not have and a
// selector that selects nothing. Of quadratic tetrahedra a listed edge, that is both of its ends, includes its midside
// node, as every region does; `tetrahedra` and `midsides` are the body's (none when they are linear).
std::vector<std::int32_t> select(const Selector& selector, const std::vector<Vec3>& rest_positions,
                                 IndexRange particles, std::span<const Tetrahedron> tetrahedra = {},
                                 std::span<const Midsides> midsides = {});

}  // namespace flexcast
