// Meshes of the scene file's shapes. Node numbers: i + (nx+1) (j + (ny+1) k). The corner with the smallest coordinates
// is the origin. Cell counts are at least 1 and sizes positive: the scene reader has checked them.
#pragma once

#include <array>

#include "core/mesh/mesh.h"

namespace flexcast {

// n springs in a row along x, n + 1 nodes.
Mesh make_rope(int cells, double length);

// A sheet of nx * ny cells in the xy plane. Springs: structural (cell edges), shear (both diagonals of a cell), bend
// (every second node along the axes). Triangles: two a cell.
Mesh make_grid(std::array<int, 2> cells, std::array<double, 2> size);

// A block of springs: edges, face diagonals and body diagonals of every cell. Triangles: its outer surface.
Mesh make_lattice(std::array<int, 3> cells, std::array<double, 3> size);

// A block of Kuhn tetrahedra: each cell gives six, one per permutation of the axes, in lexicographic order of the
// permutations; the last two vertices are swapped for odd ones so that every volume is positive.
Mesh make_beam(std::array<int, 3> cells, std::array<double, 3> size);

}  // namespace flexcast
