#include "core/solvers/ldlt.h"

#include <Eigen/SparseCholesky>
#include <bit>

namespace flexcast {

namespace {

// Tells what the analysis of the pattern found.
class Ldlt : public Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>> {
 public:
  // Entries of every column of L below the diagonal.
  const Eigen::VectorXi& column_counts() const { return m_nonZerosPerCol; }
};

}  // namespace

struct LdltSolver::Factor {
  Eigen::SparseMatrix<double> lower;  // column major: column j holds rows i >= j
  Ldlt ldlt;

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

  // False: nothing has changed.
  bool fill(const BlockMatrix& A) {
    bool changed = false;
    double* value = lower.valuePtr();
    for (int i = 0; i < A.rows(); ++i) {
      const auto columns = A.columns(i);
      const auto blocks = A.blocks(i);
      for (int c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
          const int j = columns[k];
          for (int r = j == i ? c : 0; j >= i && r < 3; ++r) {
            // Bit by bit: NaN is not what it was.
            const double now = blocks[k](c, r);
            changed = changed || std::bit_cast<std::uint64_t>(now) != std::bit_cast<std::uint64_t>(*value);
            *value++ = now;
          }
        }
      }
    }
    return changed;
  }

  bool is_factored = false, is_positive = false;
};

LdltSolver::LdltSolver() = default;
LdltSolver::~LdltSolver() = default;

void LdltSolver::make_factor(const BlockMatrix& A) {
  if (factor_) return;
  factor_ = std::make_unique<Factor>();
  factor_->make_pattern(A);
}

// A column of c entries below the diagonal takes c^2 / 2 multiplications and as many scattered additions.
double LdltSolver::predict_time(const BlockMatrix& A) {
  constexpr double per_product = 1.2e-9, per_entry = 8e-9;  // s
  make_factor(A);
  double products = 0.0, entries = 0.0;
  for (const int entries_of_column : factor_->ldlt.column_counts()) {
    const auto count = static_cast<double>(entries_of_column);
    products += 0.5 * count * count;
    entries += count;
  }
  return per_product * products + per_entry * entries;
}

LinearResult LdltSolver::solve(const BlockMatrix& A, const VecX& b, VecX& x) {
  make_factor(A);
  if (factor_->fill(A) || !factor_->is_factored) {
    factor_->ldlt.factorize(factor_->lower);
    factor_->is_factored = true;
    // Asked entry by entry: comparisons with NaN are false.
    factor_->is_positive = factor_->ldlt.info() == Eigen::Success && (factor_->ldlt.vectorD().array() > 0.0).all();
  }
  LinearResult result;
  result.positive_definite = factor_->is_positive;
  if (result.positive_definite) x = factor_->ldlt.solve(b);
  return result;
}

}  // namespace flexcast
