#include "core/mesh/mesh_file.h"

#include <new>
#include <utility>

#include "core/mesh/file_cursor.h"
#include "core/mesh/gmsh_reader.h"
#include "core/mesh/mesh_checks.h"
#include "core/mesh/tetgen_reader.h"

namespace flexcast {
namespace {

Result<MeshFile> check_and_list(const Result<NumberedMesh>& numbered, std::vector<std::filesystem::path> files) {
  if (!numbered) return numbered.error();
  Result<MeshFile> result = check_mesh(numbered.value());
  if (result) result.value().files = std::move(files);
  return result;
}

Result<MeshFile> read_gmsh_file(const std::filesystem::path& path) {
  const auto file = read_whole_file(path);
  if (!file) return file.error();
  return check_and_list(parse_gmsh(file.value()), {path});
}

Result<MeshFile> read_tetgen_pair(std::filesystem::path path) {
  const auto node_path = path.replace_extension(".node");
  const auto ele_path = path.replace_extension(".ele");
  const auto node_file = read_whole_file(node_path);
  if (!node_file) return node_file.error();
  const auto ele_file = read_whole_file(ele_path);
  if (!ele_file) return ele_file.error();
  return check_and_list(parse_tetgen(node_file.value(), ele_file.value()), {node_path, ele_path});
}

Result<MeshFile> read_by_suffix(const std::filesystem::path& path) {
  const std::string suffix = path.extension().string();
  if (suffix == ".msh") return read_gmsh_file(path);
  if (suffix == ".node" || suffix == ".ele") return read_tetgen_pair(path);
  return Error{path.string() + ": the suffix '" + suffix + "' is not one of .msh (Gmsh), .node and .ele (TetGen)"};
}

}  // namespace

Result<MeshFile> read_mesh_file(const std::filesystem::path& path) {
  // No exception leaves the readers: what is left is running out of memory.
  try {
    return read_by_suffix(path);
  } catch (const std::bad_alloc&) {
    return Error{path.string() + ": is too large for this machine's memory"};
  }
}

}  // namespace flexcast
