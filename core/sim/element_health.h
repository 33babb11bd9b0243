// How much the tetrahedra are squeezed or turned inside out: J = det F, the smallest over the quadrature points of an
// element.
#pragma once

#include <cstdint>
#include <optional>

#include "core/forces/model.h"

namespace flexcast {

struct ElementHealth {
  std::int64_t inverted = 0;    // J <= 0
  std::optional<double> min_j;  // absent without elements
};

ElementHealth calc_element_health(const Model& model, const Body& body, const VecX& positions);

}  // namespace flexcast
