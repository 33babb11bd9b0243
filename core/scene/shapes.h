// The shapes a scene can name: one row each.
#pragma once

#include <span>
#include <string_view>

#include "core/mesh/mesh.h"

namespace flexcast {

struct ShapeRow {
  std::string_view name;
  std::size_t dimensions = 0;  // how many numbers cells and size have
  bool fem = false;            // it has tetrahedra
  Mesh (*make)(std::span<const int> cells, std::span<const double> size);
};

std::span<const ShapeRow> shape_rows();

// nullptr when there is none of that name.
const ShapeRow* find_shape(std::string_view name);

}  // namespace flexcast
