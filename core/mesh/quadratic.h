// Quadratic tetrahedra (ten nodes) from linear ones (four): one more node amid every edge.
#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace flexcast {

// Appends a node at the middle of every edge, after the corner nodes and in the order of make_edges. Each triangle
// becomes four, so that the surface shows the new nodes. Returns the midside nodes of every tetrahedron.
std::vector<Midsides> make_quadratic(Mesh& mesh);

}  // namespace flexcast
