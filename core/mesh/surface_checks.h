// What every file of a surface must satisfy, and the cloth that is made of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/base/result.h"
#include "core/mesh/mesh_file.h"

namespace flexcast {

// What a reader found. Faces are polygons.
struct NumberedSurface {
  struct Face {
    std::size_t first = 0;  // in `corners`
    std::size_t count = 0;
    std::int64_t line = 0;  // of the file
  };
  std::string file;  // as errors show it
  std::vector<Vec3> nodes;
  std::vector<std::int64_t> corners;  // of all faces one after another: node numbers, from 1
  std::vector<Face> faces;
};

// Springs and triangles, no tetrahedra. Springs, each pair of nodes once:
//   - along the edges of the faces;
//   - within a face between every two nodes that have one between them (shear): both diagonals of a quadrangle;
//   - across every edge of two faces (bend): the neighbours of either end of the edge in both faces. Of two triangles
//     that are the nodes opposite to the edge, in a sheet of quadrangles every second node along its lines.
// So quadrangles in rows and columns give the springs of make_grid(). Faces of more than three nodes are divided into
// triangles, for the surface alone.
// Refused: no faces, nodes that do not exist, a node twice in a face, a face twice, faces without area, isolated nodes
// and what check_node_places() finds. The caller fills in `files`.
Result<MeshFile> make_cloth(const NumberedSurface& surface);

}  // namespace flexcast
