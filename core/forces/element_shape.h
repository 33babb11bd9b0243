// Shape functions and quadrature of straight-sided tetrahedra, linear (4 nodes) and quadratic (10), over the reference
// tetrahedron with the barycentric coordinates L_0 = 1 - xi - eta - zeta, L_1 = xi, L_2 = eta, L_3 = zeta. All points
// weigh the same. As the shape functions sum up to 1, the slopes of N_0 are minus the sum of the others and left out.
// Source: O. C. Zienkiewicz, R. L. Taylor, The Finite Element Method, volume 1, chapters 8 and 9.
#pragma once

#include <cmath>

#include "core/mesh/topology.h"

namespace flexcast {

// N_a = L_a. The gradients are constant: one point is exact.
struct LinearShape {
  static constexpr int nodes = 4;
  static constexpr int points = 1;
  static constexpr std::array<double, nodes> mass_shares = {0.25, 0.25, 0.25, 0.25};
  using Slopes = Eigen::Matrix<double, nodes - 1, 3>;  // row a - 1: dN_a / d(xi, eta, zeta)

  static Slopes calc_slopes(int /*point*/) { return Slopes::Identity(); }
};

// Corners N_a = L_a (2 L_a - 1), then midside nodes N_ab = 4 L_a L_b in the order of Midsides. Four points are exact
// for polynomials of degree 2, the linear law's energy.
struct QuadraticShape {
  static constexpr int nodes = 10;
  static constexpr int points = 4;
  static constexpr std::array<double, nodes> mass_shares = {1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 36, 4.0 / 27,
                                                            4.0 / 27, 4.0 / 27, 4.0 / 27, 4.0 / 27, 4.0 / 27};
  using Slopes = Eigen::Matrix<double, nodes - 1, 3>;

  // At point q, L_q = (5 + 3 sqrt 5) / 20 = 0.585..., the others (5 - sqrt 5) / 20 = 0.138...
  static Slopes calc_slopes(int point) {
    Eigen::Vector4d L = Eigen::Vector4d::Constant((5.0 - std::sqrt(5.0)) / 20.0);
    L[point] = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
    Eigen::Matrix<double, 4, 3> dL;
    dL << Eigen::RowVector3d::Constant(-1.0), Mat3::Identity();

    Slopes slopes;
    for (int a = 1; a < 4; ++a) slopes.row(a - 1) = (4.0 * L[a] - 1.0) * dL.row(a);
    for (int e = 0; e < 6; ++e) {
      const auto [a, b] = local_edges[static_cast<std::size_t>(e)];
      slopes.row(3 + e) = 4.0 * (L[a] * dL.row(b) + L[b] * dL.row(a));
    }
    return slopes;
  }
};

}  // namespace flexcast
