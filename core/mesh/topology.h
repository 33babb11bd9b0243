// What follows from a mesh's connections.
#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace flexcast {

// The faces that belong to exactly one tetrahedron, in element order, with outward normals.
std::vector<Triangle> make_boundary_triangles(const std::vector<Tetrahedron>& tetrahedra);

// Every edge of the tetrahedra once, as (smaller, larger) node number, sorted.
std::vector<Spring> make_edges(const std::vector<Tetrahedron>& tetrahedra);

// Six times the signed volume, det [X1-X0, X2-X0, X3-X0].
double calc_six_volumes(const std::vector<Vec3>& nodes, const Tetrahedron& tetrahedron);

}  // namespace flexcast
