#include "core/sim/element_health.h"

#include <algorithm>

namespace flexcast {
namespace {

double calc_six_volumes(const Tetrahedron& nodes, const VecX& x) {
  const Vec3 x0 = block3(x, nodes[0]);
  const Vec3 a = block3(x, nodes[1]) - x0, b = block3(x, nodes[2]) - x0, c = block3(x, nodes[3]) - x0;
  return a.dot(b.cross(c));
}

}  // namespace

ElementHealth calc_element_health(const Model& model, const Body& body, const VecX& positions) {
  ElementHealth health;
  for (std::int32_t t = body.tetrahedra.first; t < body.tetrahedra.end(); ++t) {
    const Tetrahedron& nodes = model.tetrahedra[t];
    const double J = calc_six_volumes(nodes, positions) / calc_six_volumes(nodes, model.rest_positions);
    health.min_j = std::min(health.min_j.value_or(J), J);
    if (J <= 0.0) ++health.inverted;
  }
  return health;
}

}  // namespace flexcast
