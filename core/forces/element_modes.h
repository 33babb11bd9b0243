// How fast the modes of a single element can be, with the masses of its nodes.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/forces/element.h"

namespace flexcast {

// Not below the largest eigenvalue of a positive semidefinite matrix: itself up to 3 x 3, else (tr A^4)^(1/4), which is
// above it by at most the fourth root of the size.
template <int size>
double bound_eigenvalues(const Eigen::Matrix<double, size, size>& A) {
  if constexpr (size == 1) {
    return A(0, 0);
  } else if constexpr (size == 3) {
    return Eigen::SelfAdjointEigenSolver<Mat3>(A, Eigen::EigenvaluesOnly).eigenvalues()[2];
  } else {
    return std::sqrt(A.lazyProduct(A).norm());
  }
}

// An upper bound of omega^2 at rest in 1/s^2, for node masses in kg, +infinity for held nodes. The energy of a small
// motion is at most sum_q w (mu |F'_q|^2 + lambda/2 tr(F'_q)^2), so omega^2 <= w (2 mu a + lambda b). Here a is not
// below the eigenvalues of the matrix B with the 3 x 3 blocks B_qr = sum_a grad N_a(q) grad N_a(r)^T / m_a, and b not
// below those of the matrix of their traces.
template <class Shape>
double calc_omega_squared_bound(const Element<Shape>& e, Lame elastic, const std::array<double, Shape::nodes>& masses) {
  constexpr int size = Shape::points;
  using Matrix = Eigen::Matrix<double, 3 * size, 3 * size>;
  Matrix B = Matrix::Zero();
  for (std::size_t a = 0; a < masses.size(); ++a) {
    if (std::isinf(masses[a])) continue;
    Eigen::Matrix<double, 3 * size, 1> g;
    for (int q = 0; q < size; ++q) {
      g.template segment<3>(3 * q) = e.calc_gradient(static_cast<std::size_t>(q), static_cast<std::int32_t>(a));
    }
    B += g * g.transpose() / masses[a];
  }
  Eigen::Matrix<double, size, size> traces;
  for (int q = 0; q < size; ++q) {
    for (int r = 0; r < size; ++r) traces(q, r) = B.template block<3, 3>(3 * q, 3 * r).trace();
  }
  const double a = bound_eigenvalues(B), b = bound_eigenvalues(traces);
  return e.weight * (2.0 * elastic.mu * a + std::max(elastic.lambda, 0.0) * b);
}

// The same for a mesh: the mass of each particle is shared in proportion to what the elements gave it, and the largest
// element frequency bounds that of the whole (Irons).
template <class Shape>
double calc_omega_squared_bound(const Model& model, const Body& body, Lame elastic) {
  VecX shares = VecX::Zero(body.particles.count);  // m^3
  const auto share = [&](std::int32_t node) -> double& { return shares[node - body.particles.first]; };
  for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) {
    const auto nodes = make_nodes<Shape>(model, body, t);
    const double volume = calc_rest_shape(model, body, t).volume;
    for (std::size_t a = 0; a < nodes.size(); ++a) share(nodes[a]) += Shape::mass_shares[a] * volume;
  }
  double largest = 0.0;
  for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) {
    const Element<Shape> e = make_element<Shape>(model, body, t);
    std::array<double, Shape::nodes> masses;
    for (std::size_t a = 0; a < e.nodes.size(); ++a) {
      const std::int32_t node = e.nodes[a];
      const std::uint8_t* fixed = &model.fixed[3 * static_cast<std::size_t>(node)];
      const bool held = fixed[0] && fixed[1] && fixed[2];
      masses[a] = held ? std::numeric_limits<double>::infinity()
                       : model.masses[node] * Shape::mass_shares[a] * (Shape::points * e.weight) / share(node);
    }
    largest = std::max(largest, calc_omega_squared_bound(e, elastic, masses));
  }
  return largest;
}

}  // namespace flexcast
