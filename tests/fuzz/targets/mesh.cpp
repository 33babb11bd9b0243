// Mesh files, told apart by how they begin: VTK's legacy and XML files, Gmsh's in every version, TetGen's pairs (two
// files in one input, with a line of ==== between them), else Wavefront's surfaces. What is accepted is a mesh: numbers
// in range, coordinates finite.
#include "core/mesh/gmsh_reader.h"
#include "core/mesh/obj_reader.h"
#include "core/mesh/tetgen_reader.h"
#include "core/mesh/vtk_legacy_reader.h"
#include "core/mesh/vtu_reader.h"
#include "tests/fuzz/targets/fuzz.h"

namespace flexcast::fuzz {
namespace {

constexpr std::string_view separator = "\n====\n";

void check(const Result<MeshFile>& checked) {
  if (!checked) return require(!checked.error().message.empty(), "an error without a text");
  const Mesh& mesh = checked.value().mesh;
  for (const Vec3& node : mesh.nodes) require(node.allFinite(), "a coordinate that is not finite");
  const auto nodes = static_cast<std::int64_t>(mesh.nodes.size());
  for (const auto& tetrahedron : mesh.tetrahedra)
    for (const auto node : tetrahedron) require(node >= 0 && node < nodes, "a node that does not exist");
  for (const auto& [p, q] : mesh.springs) require(p >= 0 && p < q && q < nodes, "a spring between no two nodes");
  for (const auto& triangle : mesh.triangles)
    for (const auto node : triangle) require(node >= 0 && node < nodes, "a node that does not exist");
}

void check(const Result<NumberedMesh>& numbered) {
  check(numbered ? check_mesh(numbered.value()) : numbered.error());
}

void check(const Result<NumberedSurface>& surface) {
  check(surface ? make_cloth(surface.value()) : surface.error());
}

}  // namespace
}  // namespace flexcast::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexcast;
  const std::string text = fuzz::as_text(data, size);
  const std::size_t middle = text.find(fuzz::separator);
  if (text.starts_with("# vtk")) {
    fuzz::check(parse_vtk_legacy({"input.vtk", text}));
  } else if (text.starts_with('<')) {
    fuzz::check(parse_vtu({"input.vtu", text}));
  } else if (text.starts_with('$')) {
    fuzz::check(parse_gmsh({"input.msh", text}));
  } else if (middle == std::string::npos) {
    fuzz::check(parse_obj({"input.obj", text}));
  } else {
    fuzz::check(parse_tetgen({"input.node", text.substr(0, middle)},
                             {"input.ele", text.substr(middle + fuzz::separator.size())}));
  }
  return 0;
}
