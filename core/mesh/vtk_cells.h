// The cells of VTK's unstructured grids, whatever file they come from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/mesh_checks.h"

namespace flexcast {

// As every file has them: cell i names the points connectivity[offsets[i]] to connectivity[offsets[i + 1] - 1].
struct VtkCells {
  std::vector<std::int64_t> types;         // one a cell
  std::vector<std::int64_t> offsets;       // one more than cells, from 0
  std::vector<std::int64_t> connectivity;  // point numbers
};

// Appends the tetrahedra to the elements of `mesh`; `first_node` is added to the point numbers, `first_cell` to the
// numbers of the cells in texts. Points, lines and surfaces are ignored. What is wrong with the cells: offsets that do
// not grow or leave the connectivity, volume cells of other types, tetrahedra without four points.
std::optional<std::string> append_tetrahedra(const VtkCells& cells, std::int64_t first_node, std::int64_t first_cell,
                                             NumberedMesh& mesh);

}  // namespace flexcast
