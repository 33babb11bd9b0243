// What every mesh file must satisfy, whatever its format.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/mesh/mesh_file.h"

namespace flexcast {

// What a reader found: elements refer to nodes by the file's own numbers, which may be sparse and in any order.
struct NumberedMesh {
  std::string node_file;  // the names that errors show
  std::string element_file;
  std::vector<Vec3> nodes;
  std::vector<std::int64_t> node_numbers;
  std::vector<std::array<std::int64_t, 4>> elements;
  std::vector<std::int64_t> element_numbers;
};

// Turns inverted elements round and says so; refuses everything else that is not a mesh of tetrahedra with volume.
// Node and element numbers in the texts are the file's. The caller fills in `files`.
Result<MeshFile> check_mesh(const NumberedMesh& numbered);

}  // namespace flexcast
