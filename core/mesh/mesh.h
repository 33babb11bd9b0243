// A mesh as it is generated or read: nodes and what connects them. No physics.
#pragma once

#include <vector>

#include "core/base/math.h"

namespace flexcast {

struct Mesh {
  std::vector<Vec3> nodes;              // m, rest shape
  std::vector<Tetrahedron> tetrahedra;  // positively oriented: det [X1-X0, X2-X0, X3-X0] > 0
  std::vector<Spring> springs;          // pairs of node numbers, p < q, each pair once
  std::vector<Triangle> triangles;      // boundary of the tetrahedra (outward normals), or the cells of a sheet
};

}  // namespace flexcast
