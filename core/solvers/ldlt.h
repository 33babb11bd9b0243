// Sparse LDL^T factorisation (Eigen's simplicial one with a minimum degree ordering, found once). The factor stays as
// long as the values do: a linear scene is factored once.
#pragma once

#include <memory>

#include "core/solvers/linear_solver.h"

namespace flexcast {

class LdltSolver final : public LinearSolver {
 public:
  LdltSolver();
  ~LdltSolver() override;
  // s, for a factorisation and a solution: from the pattern alone.
  double predict_time(const BlockMatrix& A);
  LinearResult solve(const BlockMatrix& A, const VecX& b, VecX& x) override;

 private:
  struct Factor;  // keeps Eigen's sparse headers out of everybody else's way
  void make_factor(const BlockMatrix& A);
  std::unique_ptr<Factor> factor_;
};

}  // namespace flexcast
