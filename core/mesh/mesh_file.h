// Reading tetrahedral meshes that other programs wrote.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/mesh.h"

namespace flexcast {

struct MeshFile {
  Mesh mesh;                                 // tetrahedra, boundary triangles; no springs
  std::vector<std::string> repairs;          // what was mended, one sentence each (re-oriented elements)
  std::vector<std::filesystem::path> files;  // every file that was read
};

// Reads Gmsh `.msh` (2.2 and 4.1, ASCII and binary) or a TetGen pair (named by its `.node` or its `.ele`, numbered from
// 0 or 1), told apart by suffix and header. Nodes keep the file's order. Errors name the file, the line or the element,
// and what is wrong: unreadable, malformed, unsupported version, index out of range, a node twice in an element, flat
// elements, duplicate or isolated nodes, no tetrahedra (a surface). The first offenders are named and all are counted.
Result<MeshFile> read_mesh_file(const std::filesystem::path& path);

}  // namespace flexcast
