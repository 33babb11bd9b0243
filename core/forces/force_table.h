// THE table of forces: one row a kind. A row's maker adds its objects for everything in the model that names it.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/forces/force.h"

namespace flexcast {

struct ForceRow {
  std::string_view name;
  std::string_view summary;
  void (*make)(const Model& model, std::vector<std::unique_ptr<Force>>& forces);
};

std::span<const ForceRow> force_rows();

}  // namespace flexcast
