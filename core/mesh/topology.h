// What follows from a mesh's connections.
#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace flexcast {

// A tetrahedron's faces, opposite to each vertex, outward for positive volumes; and its edges, in the order of
// Midsides.
inline constexpr std::array<std::array<int, 3>, 4> local_faces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
inline constexpr std::array<std::array<int, 2>, 6> local_edges = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

struct BoundaryFace {
  std::size_t tetrahedron = 0;
  std::size_t face = 0;  // of local_faces
};

// The faces that belong to exactly one tetrahedron, in element order.
std::vector<BoundaryFace> make_boundary_faces(const std::vector<Tetrahedron>& tetrahedra);
// The same as node numbers, with outward normals.
std::vector<Triangle> make_boundary_triangles(const std::vector<Tetrahedron>& tetrahedra);

// Every edge of the tetrahedra once, as (smaller, larger) node number, sorted.
std::vector<Spring> make_edges(const std::vector<Tetrahedron>& tetrahedra);

// Six times the signed volume, det [X1-X0, X2-X0, X3-X0].
double calc_six_volumes(const std::vector<Vec3>& nodes, const Tetrahedron& tetrahedron);

}  // namespace flexcast
