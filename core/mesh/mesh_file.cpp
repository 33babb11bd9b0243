#include "core/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "core/mesh/file_cursor.h"
#include "core/mesh/gmsh_reader.h"
#include "core/mesh/mesh_checks.h"
#include "core/mesh/obj_reader.h"
#include "core/mesh/tetgen_reader.h"
#include "core/mesh/vtk_legacy_reader.h"
#include "core/mesh/vtu_reader.h"

namespace flexcast {
namespace {

namespace fs = std::filesystem;

Result<MeshFile> check_and_list(const Result<NumberedMesh>& numbered, std::vector<fs::path> files) {
  if (!numbered) return numbered.error();
  Result<MeshFile> result = check_mesh(numbered.value());
  if (result) result.value().files = std::move(files);
  return result;
}

template <Result<NumberedMesh> (*parse)(const FileContent&)>
Result<MeshFile> read_tetrahedra(const fs::path& path) {
  const auto file = read_whole_file(path);
  if (!file) return file.error();
  return check_and_list(parse(file.value()), {path});
}

Result<MeshFile> read_tetgen_pair(const fs::path& path) {
  const auto node_path = fs::path(path).replace_extension(".node");
  const auto ele_path = fs::path(path).replace_extension(".ele");
  const auto node_file = read_whole_file(node_path);
  if (!node_file) return node_file.error();
  const auto ele_file = read_whole_file(ele_path);
  if (!ele_file) return ele_file.error();
  return check_and_list(parse_tetgen(node_file.value(), ele_file.value()), {node_path, ele_path});
}

Result<MeshFile> read_cloth(const fs::path& path) {
  const auto file = read_whole_file(path);
  if (!file) return file.error();
  const auto surface = parse_obj(file.value());
  if (!surface) return surface.error();
  Result<MeshFile> result = make_cloth(surface.value());
  if (result) result.value().files = {path};
  return result;
}

struct FormatRow {
  const char* suffix;
  const char* program;  // for people
  Result<MeshFile> (*read)(const fs::path& path);
};

constexpr std::array formats = {
    FormatRow{".msh", "Gmsh", read_tetrahedra<parse_gmsh>},
    FormatRow{".node", "TetGen", read_tetgen_pair},
    FormatRow{".ele", "TetGen", read_tetgen_pair},
    FormatRow{".obj", "Wavefront", read_cloth},
    FormatRow{".vtk", "VTK, legacy", read_tetrahedra<parse_vtk_legacy>},
    FormatRow{".vtu", "VTK, XML", read_tetrahedra<parse_vtu>},
};

Result<MeshFile> read_by_suffix(const fs::path& path) {
  const std::string suffix = path.extension().string();
  const auto row = std::find_if(formats.begin(), formats.end(), [&](const auto& one) { return one.suffix == suffix; });
  if (row != formats.end()) return row->read(path);
  std::string known;
  for (const FormatRow& format : formats) {
    known += (known.empty() ? "" : ", ") + std::string(format.suffix) + " (" + format.program + ")";
  }
  return Error{path.string() + ": the suffix '" + suffix + "' is not one of " + known};
}

}  // namespace

Result<MeshFile> read_mesh_file(const fs::path& path) {
  // No exception leaves the readers: what is left is running out of memory.
  try {
    return read_by_suffix(path);
  } catch (const std::bad_alloc&) {
    return Error{path.string() + ": is too large for this machine's memory"};
  }
}

}  // namespace flexcast
