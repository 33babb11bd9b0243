// Mesh files: Gmsh's in every version, and TetGen's pairs (two files in one input, with a line of ==== between them).
// What is accepted is a mesh: numbers in range, coordinates finite.
#include "core/mesh/gmsh_reader.h"
#include "core/mesh/tetgen_reader.h"
#include "tests/fuzz/targets/fuzz.h"

namespace flexcast::fuzz {
namespace {

constexpr std::string_view separator = "\n====\n";

void check(const Result<NumberedMesh>& numbered) {
  if (!numbered) return require(!numbered.error().message.empty(), "an error without a text");
  const auto checked = check_mesh(numbered.value());
  if (!checked) return require(!checked.error().message.empty(), "an error without a text");
  const Mesh& mesh = checked.value().mesh;
  for (const Vec3& node : mesh.nodes) require(node.allFinite(), "a coordinate that is not finite");
  const auto nodes = static_cast<std::int64_t>(mesh.nodes.size());
  for (const auto& tetrahedron : mesh.tetrahedra)
    for (const auto node : tetrahedron) require(node >= 0 && node < nodes, "a node that does not exist");
}

}  // namespace
}  // namespace flexcast::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexcast;
  const std::string text = fuzz::as_text(data, size);
  const std::size_t middle = text.find(fuzz::separator);
  if (middle == std::string::npos) {
    fuzz::check(parse_gmsh({"input.msh", text}));
  } else {
    fuzz::check(parse_tetgen({"input.node", text.substr(0, middle)},
                             {"input.ele", text.substr(middle + fuzz::separator.size())}));
  }
  return 0;
}
