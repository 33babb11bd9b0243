#include <array>

#include "core/materials/corotational.h"
#include "core/materials/law.h"
#include "core/materials/linear.h"
#include "core/materials/neo_hookean.h"
#include "core/materials/st_venant_kirchhoff.h"

namespace flexcast {

Lame calc_lame(double young, double poisson) {
  return {young / (2.0 * (1.0 + poisson)), young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))};
}

std::span<const Law> laws() {
  static const std::array table{linear_law, corotational_law, st_venant_kirchhoff_law, neo_hookean_law};
  return table;
}

const Law* find_law(std::string_view name) {
  for (const Law& law : laws()) {
    if (law.name == name) return &law;
  }
  return nullptr;
}

}  // namespace flexcast
