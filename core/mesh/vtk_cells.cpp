#include "core/mesh/vtk_cells.h"

#include <array>

#include "core/mesh/offenders.h"
#include "core/mesh/vtk_cell_types.h"

namespace flexcast {
namespace {

std::optional<std::string> check_offsets(const VtkCells& cells) {
  const auto& offsets = cells.offsets;
  if (offsets.size() != cells.types.size() + 1) {
    return "has " + std::to_string(offsets.size()) + " offsets where the " + std::to_string(cells.types.size()) +
           " cells need one more than their number";
  }
  if (offsets.front() != 0) return "the offsets begin with " + std::to_string(offsets.front()) + "; 0 is expected";
  for (std::size_t i = 1; i < offsets.size(); ++i) {
    if (offsets[i] >= offsets[i - 1]) continue;
    return "the offsets fall from " + std::to_string(offsets[i - 1]) + " to " + std::to_string(offsets[i]) +
           " at cell " + std::to_string(i - 1);
  }
  const auto points = static_cast<std::int64_t>(cells.connectivity.size());
  if (offsets.back() == points) return std::nullopt;
  return "the offsets end at " + std::to_string(offsets.back()) + "; the cells name " + std::to_string(points) +
         " points";
}

}  // namespace

std::optional<std::string> append_tetrahedra(const VtkCells& cells, std::int64_t first_node, std::int64_t first_cell,
                                             NumberedMesh& mesh) {
  if (auto wrong = check_offsets(cells)) return wrong;
  Offenders unknown, unsupported, malformed;
  for (std::size_t i = 0; i < cells.types.size(); ++i) {
    const std::int64_t number = first_cell + static_cast<std::int64_t>(i);
    const VtkCellType* type = find_vtk_cell_type(cells.types[i]);
    const std::int64_t points = cells.offsets[i + 1] - cells.offsets[i];
    if (type == nullptr) {
      unknown.add(std::to_string(number) + " (type " + std::to_string(cells.types[i]) + ")");
    } else if (type->dimension == 3 && type->number != vtk_tetrahedron) {
      unsupported.add(std::to_string(number) + " (" + type->name + ")");
    } else if (type->number == vtk_tetrahedron && points != 4) {
      malformed.add(std::to_string(number) + " (" + std::to_string(points) + " points)");
    } else if (type->number == vtk_tetrahedron) {
      std::array<std::int64_t, 4> vertices{};
      for (std::size_t v = 0; v < 4; ++v) {
        const std::int64_t point = cells.connectivity[static_cast<std::size_t>(cells.offsets[i]) + v];
        vertices[v] = point < 0 ? point : first_node + point;  // below 0 it stays what no node has
      }
      mesh.elements.push_back(vertices);
      mesh.element_numbers.push_back(number);
    }
  }
  if (unknown.any()) return "cell types that are not known: " + unknown.text("cell");
  if (unsupported.any()) {
    return "volume cells of types that are not supported; only the tetrahedron is: " + unsupported.text("cell");
  }
  if (malformed.any()) return "tetrahedra that do not have 4 points: " + malformed.text("cell");
  return std::nullopt;
}

}  // namespace flexcast
