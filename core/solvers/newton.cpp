#include "core/solvers/newton.h"

#include <cmath>
#include <limits>

namespace flexcast {

// False: no descent direction could be found (something is not finite).
bool NewtonSolver::find_direction(MinimizationProblem& problem, BlockMatrix& hessian, const VecX& guess, const VecX& u,
                                  NewtonResult& result) {
  right_ = -gradient_;
  for (const bool exact : {true, false}) {
    problem.calc_hessian(u, exact, hessian);
    if (result.iterations == 0) {
      direction_ = guess;
    } else {
      direction_.setZero(u.size());
    }
    const LinearResult linear = linear_->solve(hessian, right_, direction_);
    result.linear_iterations += linear.iterations;
    if (linear.positive_definite && direction_.dot(right_) > 0.0) {
      linear_converged_ = linear.converged;
      return true;
    }
  }
  return false;
}

// Armijo's rule with halving. Close to the minimum the values differ by less than their rounding: there a smaller
// gradient counts as progress.
double NewtonSolver::search_line(MinimizationProblem& problem, VecX& u, double& terms) {
  constexpr double sufficient = 1e-4, rounding = 1e-13;
  const double slope = gradient_.dot(direction_);
  const auto start = problem.calc_value(u);
  const double norm = gradient_.norm();
  double length = 1.0;
  for (int halving = 0; halving < 40; ++halving, length *= 0.5) {
    trial_ = u + length * direction_;
    const auto value = problem.calc_value(trial_);
    const bool lower = value.value <= start.value + sufficient * length * slope;
    const bool level = value.value <= start.value + rounding * (start.magnitude + value.magnitude);
    if (!lower && !level) continue;
    const double trial_terms = problem.calc_gradient(trial_, trial_gradient_);
    if (!lower && !(trial_gradient_.norm() < norm)) continue;
    u.swap(trial_);
    gradient_.swap(trial_gradient_);
    terms = trial_terms;
    return length;
  }
  terms = problem.calc_gradient(u, gradient_);
  return 0.0;
}

NewtonResult NewtonSolver::minimize(MinimizationProblem& problem, BlockMatrix& hessian, const VecX& guess, VecX& u) {
  NewtonResult result;
  double terms = problem.calc_gradient(u, gradient_), last = std::numeric_limits<double>::infinity();
  int idle = 0;
  while (true) {
    const double norm = gradient_.norm();
    result.residual = terms > 0.0 ? norm / terms : 0.0;
    // Newton's steps shorten the gradient a lot until rounding is all that is left of it.
    const double noise = problem.calc_noise();
    idle = norm <= noise && norm > 0.5 * last ? idle + 1 : 0;
    result.converged = norm <= settings_.newton_tolerance * terms + 1e-5 * noise || idle == problem.patience();
    last = norm;
    if (result.converged) return result;
    if (result.iterations >= most_iterations_) {
      result.converged = most_iterations_ == 1 && linear_converged_ && std::isfinite(result.residual);
      return result;
    }
    if (!find_direction(problem, hessian, guess, u, result)) return result;
    ++result.iterations;
    if (most_iterations_ == 1) {
      u += direction_;
      terms = problem.calc_gradient(u, gradient_);
    } else {
      const double length = search_line(problem, u, terms);
      if (length == 0.0 && norm <= noise) {
        result.converged = true;
        return result;
      }
      const bool go_on = problem.adapt(length);
      if (length == 0.0 && !go_on) return result;
    }
  }
}

}  // namespace flexcast
