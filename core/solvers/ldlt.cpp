#include "core/solvers/ldlt.h"

#include <Eigen/SparseCholesky>

namespace flexcast {

struct LdltSolver::Factor {
  Eigen::SparseMatrix<double> lower;  // column major: column j holds rows i >= j
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>> ldlt;

  // A is symmetric, so block row i of its upper triangle, transposed, is block column i of the lower one.
  void make_pattern(const BlockMatrix& A) {
    const int n = 3 * A.rows();
    std::vector<int> sizes(static_cast<std::size_t>(n), 0);
    for (int i = 0; i < A.rows(); ++i) {
      for (const int j : A.columns(i)) {
        for (int c = 0; c < 3; ++c) sizes[3 * i + c] += j > i ? 3 : j == i ? 3 - c : 0;
      }
    }
    lower.resize(n, n);
    lower.reserve(sizes);
    for (int i = 0; i < A.rows(); ++i) {
      for (int c = 0; c < 3; ++c) {
        for (const int j : A.columns(i)) {
          for (int r = j == i ? c : 0; j >= i && r < 3; ++r) lower.insert(3 * j + r, 3 * i + c) = 0.0;
        }
      }
    }
    lower.makeCompressed();
    ldlt.analyzePattern(lower);
  }

  void fill(const BlockMatrix& A) {
    double* value = lower.valuePtr();
    for (int i = 0; i < A.rows(); ++i) {
      const auto columns = A.columns(i);
      const auto blocks = A.blocks(i);
      for (int c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
          const int j = columns[k];
          for (int r = j == i ? c : 0; j >= i && r < 3; ++r) *value++ = blocks[k](c, r);
        }
      }
    }
  }
};

LdltSolver::LdltSolver() = default;
LdltSolver::~LdltSolver() = default;

LinearResult LdltSolver::solve(const BlockMatrix& A, const VecX& b, VecX& x) {
  if (!factor_) {
    factor_ = std::make_unique<Factor>();
    factor_->make_pattern(A);
  }
  factor_->fill(A);
  factor_->ldlt.factorize(factor_->lower);
  LinearResult result;
  // Asked entry by entry: comparisons with NaN are false.
  result.positive_definite = factor_->ldlt.info() == Eigen::Success && (factor_->ldlt.vectorD().array() > 0.0).all();
  if (result.positive_definite) x = factor_->ldlt.solve(b);
  return result;
}

}  // namespace flexcast
