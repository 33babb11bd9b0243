// Reading meshes that other programs wrote: tetrahedra, and surfaces for cloth.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/mesh.h"

namespace flexcast {

struct MeshFile {
  Mesh mesh;                         // tetrahedra and boundary triangles; or springs and triangles, of a surface
  std::vector<std::string> repairs;  // what was mended, one sentence each (re-oriented elements)
  std::vector<std::filesystem::path> files;  // every file that was read
};

// Reads Gmsh `.msh` (2.2 and 4.1, ASCII and binary), a TetGen pair (named by its `.node` or its `.ele`, numbered from 0
// or 1), VTK's tetrahedra (legacy `.vtk` up to 5.1, ASCII and binary; XML `.vtu`) or a Wavefront `.obj` (a surface, see
// make_cloth()), told apart by suffix and header. Nodes keep the file's order. Errors name the file, the line or the
// element, and what is wrong: unreadable, malformed, unsupported version, index out of range, a node twice in an
// element, flat elements, duplicate or isolated nodes, no tetrahedra. The first offenders are named and all are
// counted.
Result<MeshFile> read_mesh_file(const std::filesystem::path& path);

}  // namespace flexcast
