#include "core/sim/element_health.h"

#include <algorithm>
#include <limits>

#include "core/forces/element_shape.h"

namespace flexcast {
namespace {

double calc_determinant(const Mat3& A) {
  return A.col(0).dot(A.col(1).cross(A.col(2)));
}

// Columns x_a - x_0.
template <class Shape>
Eigen::Matrix<double, 3, Shape::nodes - 1> calc_edges(const Model& model, const Body& body, std::int32_t t,
                                                      const VecX& x) {
  Eigen::Matrix<double, 3, Shape::nodes - 1> edges;
  const Tetrahedron& corners = model.tetrahedra[body.tetrahedra.first + t];
  const Vec3 x0 = block3(x, corners[0]);
  for (int a = 1; a < 4; ++a) edges.col(a - 1) = block3(x, corners[static_cast<std::size_t>(a)]) - x0;
  if constexpr (Shape::nodes == 10) {
    const Midsides& midsides = model.midsides[body.midsides.first + t];
    for (int e = 0; e < 6; ++e) edges.col(3 + e) = block3(x, midsides[static_cast<std::size_t>(e)]) - x0;
  }
  return edges;
}

// The smallest J over the quadrature points of an element: both shapes are maps from the reference tetrahedron.
template <class Shape>
double calc_min_j(const Model& model, const Body& body, std::int32_t t, const VecX& positions) {
  const double rest = calc_determinant(calc_edges<LinearShape>(model, body, t, model.rest_positions));
  const auto edges = calc_edges<Shape>(model, body, t, positions);
  double min_j = std::numeric_limits<double>::infinity();
  for (int q = 0; q < Shape::points; ++q) {
    const Mat3 map = edges * Shape::calc_slopes(q);
    min_j = std::min(min_j, calc_determinant(map) / rest);
  }
  return min_j;
}

}  // namespace

ElementHealth calc_element_health(const Model& model, const Body& body, const VecX& positions) {
  ElementHealth health;
  for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) {
    const double J = body.is_quadratic() ? calc_min_j<QuadraticShape>(model, body, t, positions)
                                         : calc_min_j<LinearShape>(model, body, t, positions);
    health.min_j = std::min(health.min_j.value_or(J), J);
    if (J <= 0.0) ++health.inverted;
  }
  return health;
}

}  // namespace flexcast
