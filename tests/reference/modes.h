// Natural frequencies of a model: K u = omega^2 M u, as M^-1/2 K M^-1/2 over the free degrees of freedom, by the
// Lanczos method on it or its inverse. Source: T. Ericsson, A. Ruhe, Math. Comput. 35 (1980) 1251-1268.
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

#include "core/forces/system.h"
#include "tests/support/random.h"

namespace flexcast::test {

// M^-1/2 K M^-1/2 of what can move, 1/s^2.
inline Eigen::SparseMatrix<double> make_scaled_stiffness(Model model, const VecX& x) {
  update_masses(model);
  const System system(model);
  BlockMatrix matrix = system.make_matrix();
  matrix.set_zero();
  system.add_stiffness(x, 1.0, Tangent::exact, matrix);
  std::vector<Eigen::Index> index(static_cast<std::size_t>(system.dofs()), -1);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < system.dofs(); ++i) {
    if (system.free()[i] != 0.0) index[static_cast<std::size_t>(i)] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (std::int32_t row = 0; row < matrix.rows(); ++row) {
    const auto columns = matrix.columns(row);
    const auto blocks = matrix.blocks(row);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double scale = 1.0 / std::sqrt(model.masses[row] * model.masses[columns[k]]);
      for (int a = 0; a < 9; ++a) {
        const Eigen::Index i = index[static_cast<std::size_t>(3 * row + a % 3)];
        const Eigen::Index j = index[static_cast<std::size_t>(3 * columns[k] + a / 3)];
        if (i >= 0 && j >= 0) entries.emplace_back(i, j, scale * blocks[k](a % 3, a / 3));
      }
    }
  }
  Eigen::SparseMatrix<double> scaled(count, count);
  scaled.setFromTriplets(entries.begin(), entries.end());
  return scaled;
}

// Orthonormal Lanczos vectors and the operator between them, from a random start.
template <class Operator>
VecX calc_ritz_values(Eigen::Index rows, Eigen::Index size, Operator apply) {
  Eigen::MatrixXd basis(rows, size), projected(size, size);
  SplitMix64 random(11);
  VecX next = make_random_vector(random, rows, 1.0);
  for (Eigen::Index k = 0; k < size; ++k) {
    for (int twice = 0; twice < 2; ++twice) {
      const VecX overlap = basis.leftCols(k).transpose() * next;
      next -= basis.leftCols(k) * overlap;
    }
    basis.col(k) = next.normalized();
    next = apply(VecX(basis.col(k)));
    projected.col(k).head(k + 1) = basis.leftCols(k + 1).transpose() * next;
    projected.row(k).head(k + 1) = projected.col(k).head(k + 1).transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(projected, Eigen::EigenvaluesOnly).eigenvalues();
}

// rad/s.
inline double calc_largest_omega(const Eigen::SparseMatrix<double>& A) {
  return std::sqrt(calc_ritz_values(A.rows(), 200, [&](const VecX& x) { return VecX(A * x); }).maxCoeff());
}

// Hz, ascending; nothing may move freely.
inline std::vector<double> calc_lowest_frequencies(const Model& model, int wanted) {
  const Eigen::SparseMatrix<double> A = make_scaled_stiffness(model, model.rest_positions);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(A);
  const Eigen::Index size = std::min<Eigen::Index>(A.rows(), 20 + 6 * wanted);
  const VecX inverses = calc_ritz_values(A.rows(), size, [&](const VecX& x) { return VecX(factor.solve(x)); });
  std::vector<double> frequencies;
  for (int k = 0; k < wanted; ++k) {
    frequencies.push_back(1.0 / std::sqrt(inverses[size - 1 - k]) / (2.0 * std::numbers::pi));
  }
  return frequencies;
}

}  // namespace flexcast::test
