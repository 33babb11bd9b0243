#include "core/integrators/backward_euler.h"

#include <limits>

#include "core/solvers/newton.h"

namespace flexcast {
namespace {

// The incremental potential of one step as a function of the displacement u.
class IncrementalPotential final : public MinimizationProblem {
 public:
  explicit IncrementalPotential(const System& system) : base_(system.make_matrix()) {}

  BlockMatrix make_hessian() const { return base_; }
  const VecX& drift() const { return drift_; }  // h v: the displacement without forces

  void begin(const System& system, double h, const State& state) {
    system_ = &system;
    h_ = h;
    start_ = &state.positions;
    drift_ = h * state.velocities;
    system.calc_constant(constant_);
    constant_ = constant_.cwiseProduct(system.free());
    base_.set_zero();
    base_.add_diagonal(system.masses() / (h * h));
    if (system.has_damping()) system.add_damping_matrix(*start_, 1.0 / h, base_);
  }

  Value calc_value(const VecX& u) override {
    x_ = *start_ + u;
    inertia_ = u - drift_;
    const double kinetic = 0.5 / (h_ * h_) * inertia_.dot(system_->masses().cwiseProduct(inertia_));
    const double elastic = system_->calc_position_dependent_energy(x_);
    const double constant = -constant_.dot(u);
    double dissipation = 0.0;
    if (system_->has_damping()) {
      calc_damping(u);
      dissipation = -0.5 * damping_.dot(u);
    }
    return {kinetic + elastic + constant + dissipation, kinetic + std::abs(elastic) + std::abs(constant) + dissipation};
  }

  double calc_gradient(const VecX& u, VecX& gradient) override {
    const VecX& free = system_->free();
    x_ = *start_ + u;
    inertia_ = system_->masses().cwiseProduct(u - drift_).cwiseProduct(free) / (h_ * h_);
    system_->calc_position_dependent(x_, force_);
    force_ = force_.cwiseProduct(free);
    gradient = inertia_ - force_ - constant_;
    double terms = inertia_.norm() + force_.norm() + constant_.norm();
    if (system_->has_damping()) {
      calc_damping(u);
      damping_ = damping_.cwiseProduct(free);
      gradient -= damping_;
      terms += damping_.norm();
    }
    return terms;
  }

  void calc_hessian(const VecX& u, bool exact, BlockMatrix& hessian) override {
    x_ = *start_ + u;
    hessian.assign_values(base_);
    system_->add_stiffness(x_, 1.0, exact ? Tangent::exact : Tangent::positive_semidefinite, hessian);
    hessian.hold(system_->free());
  }

 private:
  void calc_damping(const VecX& u) {
    velocity_ = u / h_;
    system_->calc_damping(*start_, velocity_, damping_);
  }

  const System* system_ = nullptr;
  const VecX* start_ = nullptr;
  double h_ = 0.0;
  BlockMatrix base_;  // M / h^2 + D / h
  VecX drift_, constant_, x_, inertia_, force_, velocity_, damping_;
};

class BackwardEuler final : public Integrator {
 public:
  BackwardEuler(const System& system, const SolverSettings& settings)
      : potential_(system), newton_(settings, system.dofs() / 3), hessian_(potential_.make_hessian()) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    potential_.begin(system, h, state);
    u_.setZero(system.dofs());
    const NewtonResult result = newton_.minimize(potential_, hessian_, potential_.drift(), u_);
    state.positions += u_;
    state.velocities = u_ / h;
    statistics.residual = result.residual;
    statistics.iterations += result.iterations;
    statistics.linear_iterations += result.linear_iterations;
    statistics.converged = statistics.converged && result.converged;
  }

 private:
  IncrementalPotential potential_;
  NewtonSolver newton_;
  BlockMatrix hessian_;
  VecX u_;
};

}  // namespace

const IntegratorRow backward_euler_row{
    "backward_euler",
    "implicit: stable at any step, damps what it does not resolve",
    1,
    true,
    [](double, double) { return std::numeric_limits<double>::infinity(); },
    [](const System& system, const SolverSettings& settings) -> std::unique_ptr<Integrator> {
      return std::make_unique<BackwardEuler>(system, settings);
    }};

}  // namespace flexcast
