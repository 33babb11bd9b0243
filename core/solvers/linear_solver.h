// Linear systems A x = b with A symmetric, in 3 x 3 blocks.
#pragma once

#include <memory>

#include "core/base/block_matrix.h"
#include "core/solvers/settings.h"

namespace flexcast {

struct LinearResult {
  bool positive_definite = true;  // false: a direction of non-positive curvature was met; x is of no use
  bool converged = true;          // false: the tolerance was not reached; x is the best found
  int iterations = 0;             // 0 for direct solvers
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  // x: a guess on entry (iterative solvers start from it; of b's size), the solution on return. The pattern of A must
  // be the same at every call.
  virtual LinearResult solve(const BlockMatrix& A, const VecX& b, VecX& x) = 0;
};

// settings.linear: "ldlt"; "pcg", conjugate gradients with multigrid, or with block-Jacobi for few particles; or
// "auto", ldlt where that should be faster. The choice follows from the first matrix's pattern alone, never from a
// clock. rest_positions: m, 3 a block row, where multigrid lays its grids.
std::unique_ptr<LinearSolver> make_linear_solver(const SolverSettings& settings, const VecX& rest_positions);

}  // namespace flexcast
