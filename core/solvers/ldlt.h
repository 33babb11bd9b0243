// Sparse LDL^T factorisation (Eigen's simplicial one with a minimum degree ordering, found once).
#pragma once

#include <memory>

#include "core/solvers/linear_solver.h"

namespace flexcast {

class LdltSolver final : public LinearSolver {
 public:
  LdltSolver();
  ~LdltSolver() override;
  LinearResult solve(const BlockMatrix& A, const VecX& b, VecX& x) override;

 private:
  struct Factor;  // keeps Eigen's sparse headers out of everybody else's way
  std::unique_ptr<Factor> factor_;
};

}  // namespace flexcast
