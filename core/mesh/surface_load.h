// A force spread over a part of a body's surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace flexcast {

// Adds to the nodal forces those of a uniform traction, `force` in N altogether, on the boundary faces whose three
// corners are selected (one flag a node, 0: not). Consistent with the shape functions on straight faces: a linear face
// gives a third of its load to each corner, a quadratic one a third to each midside node and nothing to the corners.
// `nodes` in m, the rest shape; `midsides` is empty for linear tetrahedra. Returns the area of these faces in m^2; when
// that is 0 nothing is added.
double spread_surface_force(std::span<const std::uint8_t> selected, const std::vector<Vec3>& nodes,
                            const std::vector<Tetrahedron>& tetrahedra, const std::vector<Midsides>& midsides,
                            const Vec3& force, std::vector<Vec3>& forces);

}  // namespace flexcast
