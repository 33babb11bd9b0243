// Polygons as the faces of a surface: whether they have an area, and triangles that cover them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/math.h"

namespace flexcast {

using Polygon = std::span<const std::int32_t>;  // node numbers, three or more

// Its nodes about the first one, in units of its size, so that areas neither overflow nor vanish. No two nodes may lie
// at one place.
std::vector<Vec3> make_outline(const std::vector<Vec3>& nodes, Polygon polygon);

// Whether the vector area is more than what rounding makes. A bow whose halves cancel each other has none.
bool has_area(const std::vector<Vec3>& outline);

// Triangles about one of its corners, one from which the whole polygon is seen if there is any among the first ones.
void append_triangles(Polygon polygon, const std::vector<Vec3>& outline, std::vector<Triangle>& triangles);

}  // namespace flexcast
