// The engine's assembled matrices as dense ones.
#pragma once

#include "core/forces/system.h"

namespace flexcast::test {

inline Eigen::MatrixXd to_dense(const BlockMatrix& matrix) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * matrix.rows(), 3 * matrix.rows());
  for (std::int32_t row = 0; row < matrix.rows(); ++row) {
    const auto columns = matrix.columns(row);
    const auto blocks = matrix.blocks(row);
    for (std::size_t k = 0; k < columns.size(); ++k) dense.block<3, 3>(3 * row, 3 * columns[k]) = blocks[k];
  }
  return dense;
}

// K = -df/dx of the conservative forces, N/m. Computes the model's masses.
inline Eigen::MatrixXd calc_stiffness(Model model, const VecX& positions, Tangent kind = Tangent::exact) {
  update_masses(model);
  const System system(model);
  BlockMatrix matrix = system.make_matrix();
  matrix.set_zero();
  system.add_stiffness(positions, 1.0, kind, matrix);
  return to_dense(matrix);
}

}  // namespace flexcast::test
