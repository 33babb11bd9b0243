// Preconditioned conjugate gradients.
// Source: Y. Saad, Iterative Methods for Sparse Linear Systems, SIAM 2003, algorithm 9.1.
#pragma once

#include <vector>

#include "core/solvers/linear_solver.h"
#include "core/solvers/preconditioner.h"

namespace flexcast {

class PcgSolver final : public LinearSolver {
 public:
  // Ends when |b - A x| <= tolerance |b|.
  PcgSolver(double tolerance, std::unique_ptr<Preconditioner> preconditioner)
      : tolerance_(tolerance), preconditioner_(std::move(preconditioner)) {}
  LinearResult solve(const BlockMatrix& A, const VecX& b, VecX& x) override;

 private:
  // Takes a step of length alpha along p; the new residual's square and, preconditioned, its product with that.
  double advance(double alpha, VecX& x, double& rz);
  void turn(double beta);
  double dot(const VecX& a, const VecX& b);

  double tolerance_;
  std::unique_ptr<Preconditioner> preconditioner_;
  VecX r_, z_, p_, Ap_;
  std::vector<double> partial_;
};

}  // namespace flexcast
