#include "core/scene/shapes.h"

#include <algorithm>

#include "core/mesh/generators.h"

namespace flexcast {
namespace {
using Cells = std::span<const int>;
using Size = std::span<const double>;

Mesh rope(Cells cells, Size size) {
  return make_rope(cells[0], size[0]);
}
Mesh grid(Cells cells, Size size) {
  return make_grid({cells[0], cells[1]}, {size[0], size[1]});
}
Mesh lattice(Cells cells, Size size) {
  return make_lattice({cells[0], cells[1], cells[2]}, {size[0], size[1], size[2]});
}
Mesh beam(Cells cells, Size size) {
  return make_beam({cells[0], cells[1], cells[2]}, {size[0], size[1], size[2]});
}

constexpr ShapeRow rows[] = {
    {"rope", 1, false, rope},
    {"grid", 2, false, grid},
    {"lattice", 3, false, lattice},
    {"beam", 3, true, beam},
};
}  // namespace

std::span<const ShapeRow> shape_rows() {
  return rows;
}

const ShapeRow* find_shape(std::string_view name) {
  const auto row = std::ranges::find(rows, name, &ShapeRow::name);
  return row == std::end(rows) ? nullptr : row;
}

}  // namespace flexcast
