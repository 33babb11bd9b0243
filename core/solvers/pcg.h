// Preconditioned conjugate gradients; the preconditioner is the inverse of the 3 x 3 diagonal blocks.
// Source: Y. Saad, Iterative Methods for Sparse Linear Systems, SIAM 2003, algorithm 9.1.
#pragma once

#include <vector>

#include "core/solvers/linear_solver.h"

namespace flexcast {

class PcgSolver final : public LinearSolver {
 public:
  // Ends when |b - A x| <= tolerance |b|.
  explicit PcgSolver(double tolerance) : tolerance_(tolerance) {}
  LinearResult solve(const BlockMatrix& A, const VecX& b, VecX& x) override;

 private:
  bool invert_diagonal(const BlockMatrix& A);
  void precondition(const VecX& r, VecX& z) const;

  double tolerance_;
  std::vector<Mat3> inverse_diagonal_;
  VecX r_, z_, p_, Ap_;
};

}  // namespace flexcast
