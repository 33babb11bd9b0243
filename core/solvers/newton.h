// Newton's method with line search for the minimum of a smooth function, as implicit schemes need it.
// Source: J. Nocedal, S. J. Wright, Numerical Optimization, Springer 2006, chapters 3 and 6.
#pragma once

#include <algorithm>

#include "core/solvers/linear_solver.h"

namespace flexcast {

class MinimizationProblem {
 public:
  virtual ~MinimizationProblem() = default;
  struct Value {
    double value = 0.0;
    double magnitude = 0.0;  // sum of the terms' absolute values: what rounding is relative to
  };
  virtual Value calc_value(const VecX& u) = 0;
  // Returns the summed norms of the gradient's terms: what its own norm is compared with. Zero at held entries.
  virtual double calc_gradient(const VecX& u, VecX& gradient) = 0;
  // The norm that rounding alone gives a gradient: where none smaller can be found, one below it is as good as zero.
  virtual double calc_noise() const { return 0.0; }
  // After how many iterations without progress below the noise that is so; more where Hessians are shifted.
  virtual int patience() const { return 1; }
  // Exact, or a positive definite neighbour of it.
  virtual void calc_hessian(const VecX& u, bool exact, BlockMatrix& hessian) = 0;
  // Told after each line search how much of the direction was taken, 0: none. A problem that shifts its Hessians adapts
  // them; true after 0: another direction is worth trying.
  virtual bool adapt(double /*length*/) { return false; }
};

struct NewtonResult {
  bool converged = false;  // the tolerance was reached; with one iteration: the linear solve reached its own
  int iterations = 0;
  int linear_iterations = 0;
  double residual = 0.0;  // |gradient| / summed norms of its terms, at the end
};

// Scratch that outlives a solve, so that steps need not allocate.
class NewtonSolver {
 public:
  NewtonSolver(const SolverSettings& settings, const VecX& rest_positions)
      : settings_(settings),
        most_iterations_(settings.newton_iterations),
        linear_(make_linear_solver(settings, rest_positions)) {}

  // Improves u in place; `guess` is where the first iteration may expect its step to go. With newton_iterations = 1 it
  // takes the full Newton step, without a search: the linearly implicit schemes. `residual` then says how far from the
  // nonlinear solution that ends. A hessian that turns out indefinite is replaced by its positive definite neighbour.
  // The problem's last calc_gradient was at the returned u, and gradient() is its result.
  NewtonResult minimize(MinimizationProblem& problem, BlockMatrix& hessian, const VecX& guess, VecX& u);
  const VecX& gradient() const { return gradient_; }
  // At most so many iterations, and never more than the settings'; 0: as many as those.
  void limit_iterations(int most) {
    most_iterations_ = most > 0 ? std::min(most, settings_.newton_iterations) : settings_.newton_iterations;
  }

 private:
  bool find_direction(MinimizationProblem& problem, BlockMatrix& hessian, const VecX& guess, const VecX& u,
                      NewtonResult& result);
  // The length taken, 0: nothing on the line is better.
  double search_line(MinimizationProblem& problem, VecX& u, double& terms);

  SolverSettings settings_;
  int most_iterations_;
  std::unique_ptr<LinearSolver> linear_;
  VecX gradient_, trial_gradient_, right_, direction_, trial_;
  bool linear_converged_ = false;
};

}  // namespace flexcast
