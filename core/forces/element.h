// One element of a tetrahedral mesh: what is known of it at rest, and how the gradients of its nodes' motion and the
// forces at its nodes follow from that. Shape: see element_shape.h.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <span>

#include "core/base/block_matrix.h"
#include "core/forces/element_shape.h"
#include "core/forces/model.h"

namespace flexcast {

template <class Shape>
struct Element {
  using Gradients = typename Shape::Slopes;
  using Edges = Eigen::Matrix<double, 3, Shape::nodes - 1>;
  using NodeVectors = Eigen::Matrix<double, 3, Shape::nodes>;

  std::array<std::int32_t, Shape::nodes> nodes;    // of the world
  std::array<Gradients, Shape::points> gradients;  // 1/m, rows grad N_1, grad N_2, ... at the quadrature points
  double weight;                                   // m^3, the rest volume that a quadrature point stands for

  // Columns x_a - x_0.
  Edges calc_edges(const VecX& x) const {
    Edges edges;
    const Vec3 x0 = block3(x, nodes[0]);
    for (int a = 1; a < Shape::nodes; ++a) edges.col(a - 1) = block3(x, nodes[static_cast<std::size_t>(a)]) - x0;
    return edges;
  }

  // sum_a x_a grad N_a^T at every quadrature point: F of positions, F' of velocities.
  void calc_gradients(const VecX& x, std::span<Mat3, Shape::points> F) const {
    const Edges edges = calc_edges(x);
    for (std::size_t q = 0; q < Shape::points; ++q) F[q] = edges * gradients[q];
  }

  // grad N_a.
  Vec3 calc_gradient(std::size_t point, std::int32_t a) const {
    return a == 0 ? Vec3(-gradients[point].colwise().sum()) : Vec3(gradients[point].row(a - 1));
  }

  // Columns sum_q w P_q grad N_a: the slopes of the energy with respect to x_a.
  NodeVectors calc_node_slopes(std::span<const Mat3, Shape::points> P) const {
    Edges others = weight * P[0] * gradients[0].transpose();
    for (std::size_t q = 1; q < Shape::points; ++q) others += weight * P[q] * gradients[q].transpose();
    NodeVectors slopes;
    slopes << -others.rowwise().sum(), others;
    return slopes;
  }
};

// Particles of the world of number `t` of the body's tetrahedra.
template <class Shape>
std::array<std::int32_t, Shape::nodes> make_nodes(const Model& model, const Body& body, std::int32_t t) {
  std::array<std::int32_t, Shape::nodes> nodes;
  const Tetrahedron& corners = model.tetrahedra[body.tetrahedra.first + t];
  std::copy(corners.begin(), corners.end(), nodes.begin());
  if constexpr (Shape::nodes == 10) {
    const Midsides& midsides = model.midsides[body.midsides.first + t];
    std::copy(midsides.begin(), midsides.end(), nodes.begin() + 4);
  }
  return nodes;
}

// Straight sides: the corners alone map the reference tetrahedron to the one at rest.
struct RestShape {
  Mat3 inverse_edges;  // 1/m, [X1-X0, X2-X0, X3-X0]^-1
  double volume;       // m^3
};
inline RestShape calc_rest_shape(const Model& model, const Body& body, std::int32_t t) {
  const auto [a, b, c, d] = model.tetrahedra[body.tetrahedra.first + t];
  const VecX& X = model.rest_positions;
  Mat3 edges;
  edges << block3(X, b) - block3(X, a), block3(X, c) - block3(X, a), block3(X, d) - block3(X, a);
  return {edges.inverse(), edges.determinant() / 6.0};
}

template <class Shape>
Element<Shape> make_element(const Model& model, const Body& body, std::int32_t t) {
  const RestShape rest = calc_rest_shape(model, body, t);
  Element<Shape> e;
  e.nodes = make_nodes<Shape>(model, body, t);
  for (int q = 0; q < Shape::points; ++q) {
    e.gradients[static_cast<std::size_t>(q)] = Shape::calc_slopes(q) * rest.inverse_edges;
  }
  e.weight = rest.volume / Shape::points;
  return e;
}

// f_a -= sum_q w P_q grad N_a.
template <class Shape>
void add_stress_forces(const Element<Shape>& e, std::span<const Mat3, Shape::points> P, VecX& f) {
  const typename Element<Shape>::NodeVectors slopes = e.calc_node_slopes(P);
  for (int a = 0; a < Shape::nodes; ++a) block3(f, e.nodes[static_cast<std::size_t>(a)]) -= slopes.col(a);
}

// C . g and g . (C . h) of a 9 x 9 matrix C = dP/dF (columns of F one below the other): C_ijkl g_l and g_j C_ijkl h_l.
using HalfTangent = Eigen::Matrix<double, 9, 3>;
inline HalfTangent contract_right(const Mat9& C, const Vec3& g) {
  HalfTangent half = HalfTangent::Zero();
  for (int l = 0; l < 3; ++l) half += g[l] * C.middleCols<3>(3 * l);
  return half;
}
inline Mat3 contract_left(const Vec3& g, const HalfTangent& half) {
  Mat3 block = Mat3::Zero();
  for (int j = 0; j < 3; ++j) block += g[j] * half.middleRows<3>(3 * j);
  return block;
}

// The blocks sum_q grad N_a . C_q . grad N_b of all nodes a: entry (a, i) of matrix k is entry (i, k) of the block.
// Long columns, as they are quicker to add.
template <class Shape>
std::array<Eigen::Matrix<double, Shape::nodes, 3>, 3> calc_tangent_column(
    std::span<const Eigen::Matrix<double, Shape::nodes, 3>, Shape::points> g, std::span<const Mat9, Shape::points> C,
    int b) {
  std::array<Eigen::Matrix<double, Shape::nodes, 3>, 3> column;
  for (auto& part : column) part.setZero();
  for (std::size_t q = 0; q < Shape::points; ++q) {
    const HalfTangent half = contract_right(C[q], g[q].row(b));
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) column[static_cast<std::size_t>(k)].col(i) += half(i + 3 * j, k) * g[q].col(j);
      }
    }
  }
  return column;
}

// A += the blocks scale sum_q w grad N_a . C_q . grad N_b.
template <class Shape>
void add_tangent_blocks(const Element<Shape>& e, std::span<const Mat9, Shape::points> C, double scale, BlockMatrix& A) {
  std::array<Eigen::Matrix<double, Shape::nodes, 3>, Shape::points> g;  // grad N_a in rows
  for (std::size_t q = 0; q < Shape::points; ++q) {
    for (int a = 0; a < Shape::nodes; ++a) g[q].row(a) = e.calc_gradient(q, a);
  }
  for (int b = 0; b < Shape::nodes; ++b) {
    const auto column = calc_tangent_column<Shape>(g, C, b);
    for (int a = 0; a < Shape::nodes; ++a) {
      Mat3 block;
      for (int k = 0; k < 3; ++k) block.col(k) = scale * e.weight * column[static_cast<std::size_t>(k)].row(a);
      A.add(e.nodes[static_cast<std::size_t>(a)], e.nodes[static_cast<std::size_t>(b)], block);
    }
  }
}

}  // namespace flexcast
