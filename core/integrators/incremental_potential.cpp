#include "core/integrators/incremental_potential.h"

#include "core/forces/friction.h"

namespace flexcast {

BlockMatrix IncrementalPotential::make_hessian(const System& system) {
  base_matrix_ = system.make_matrix();
  return base_matrix_;
}

void IncrementalPotential::begin(const System& system, const ImplicitStage& stage, VecX& u) {
  system_ = &system;
  stage_ = &stage;
  slip_ = 1e-4 * system.size() * stage.length;
  // Elastic forces suffer from the rounding of positions, inertia from that of the displacement.
  noise_ = 1e-14 * (system.size() * system.stiffness_norm() +
                    system.masses().cwiseProduct(stage.base_velocity).norm() / stage.length);
  friction_.clear();
  u.setZero(system.dofs());
  if (system.has_handles()) {
    x_ = stage.base;
    system.prescribe(stage.end_time, x_, velocity_ = stage.base_velocity);
    u = x_ - stage.base;
  }
  system.calc_constant(constant_);
  base_is_valid_ = false;
  if (system.has_friction()) update_friction(stage.length * stage.base_velocity.cwiseProduct(system.free()) + u);
}

VecX IncrementalPotential::calc_drift() const {
  return stage_->length * stage_->base_velocity.cwiseProduct(system_->free());
}

MinimizationProblem::Value IncrementalPotential::calc_value(const VecX& u) {
  const double g = stage_->length;
  x_ = stage_->base + u;
  inertia_ = (u - g * stage_->base_velocity).cwiseProduct(system_->free());
  const double kinetic = 0.5 / (g * g) * inertia_.dot(system_->masses().cwiseProduct(inertia_));
  const double elastic = system_->calc_position_dependent_energy(x_);
  const double constant = -constant_.dot(u);
  double dissipation = 0.0;
  if (system_->has_damping()) {
    velocity_ = u / g;
    dissipation = 0.5 * g * system_->calc_damping(stage_->damped_at, velocity_, damping_);
  }
  for (const FrictionPoint& point : friction_) {
    dissipation += calc_friction_potential(point, slip_, block3(u, point.particle)).value;
  }
  return {kinetic + elastic + constant + dissipation, kinetic + std::abs(elastic) + std::abs(constant) + dissipation};
}

double IncrementalPotential::calc_gradient(const VecX& u, VecX& gradient) {
  const VecX& free = system_->free();
  const double g = stage_->length;
  x_ = stage_->base + u;
  inertia_ = system_->masses().cwiseProduct(u - g * stage_->base_velocity).cwiseProduct(free) / (g * g);
  system_->calc_position_dependent(x_, elastic_);
  force_ = elastic_ + constant_;
  // Reactions of what is held count among the terms.
  double terms = inertia_.norm() + elastic_.norm() + constant_.norm();
  damping_power_ = 0.0;
  if (system_->has_damping()) {
    velocity_ = u / g;
    damping_power_ = system_->calc_damping(stage_->damped_at, velocity_, damping_);
    force_ += damping_;
    terms += damping_.norm();
  }
  if (!friction_.empty()) {
    sliding_.setZero(u.size());
    for (const FrictionPoint& point : friction_) {
      block3(sliding_, point.particle) -= calc_friction_potential(point, slip_, block3(u, point.particle)).gradient;
    }
    force_ += sliding_;
    terms += sliding_.norm();
  }
  gradient = inertia_ - force_.cwiseProduct(free);
  return terms;
}

void IncrementalPotential::calc_hessian(const VecX& u, bool exact, BlockMatrix& hessian) {
  if (!base_is_valid_) {
    base_matrix_.set_zero();
    base_matrix_.add_diagonal(system_->masses() / (stage_->length * stage_->length));
    if (system_->has_damping()) system_->add_damping_matrix(stage_->damped_at, 1.0 / stage_->length, base_matrix_);
    base_is_valid_ = true;
  }
  x_ = stage_->base + u;
  hessian.assign_values(base_matrix_);
  system_->add_stiffness(x_, 1.0, exact ? Tangent::exact : Tangent::positive_semidefinite, hessian);
  for (const FrictionPoint& point : friction_) {
    hessian.add(point.particle, point.particle, calc_friction_tangent(point, slip_, block3(u, point.particle)));
  }
  hessian.hold(system_->free());
}

double IncrementalPotential::calc_dissipated_power(const VecX& u) const {
  double power = damping_power_;
  for (const FrictionPoint& point : friction_) {
    const Vec3 slid = block3(u, point.particle);
    power += calc_friction_potential(point, slip_, slid).gradient.dot(slid) / stage_->length;
  }
  return power;
}

bool IncrementalPotential::update_friction(const VecX& u) {
  const auto total = [](const std::vector<FrictionPoint>& points) {
    double sum = 0.0;
    for (const FrictionPoint& point : points) sum += point.limit;
    return sum;
  };
  std::vector<FrictionPoint> now = system_->find_friction_points(stage_->base + u);
  if (std::abs(total(now) - total(friction_)) <= 1e-3 * total(now)) return false;
  friction_ = std::move(now);
  return true;
}

void ImplicitSolver::solve(const System& system, const ImplicitStage& stage, VecX& u, StepStatistics& statistics) {
  constexpr int most_friction_rounds = 5;
  potential_.begin(system, stage, u);
  NewtonResult result;
  for (int round = 0; round < most_friction_rounds; ++round) {
    result = newton_.minimize(potential_, hessian_, potential_.calc_drift() - u.cwiseProduct(system.free()), u);
    statistics.iterations += result.iterations;
    statistics.linear_iterations += result.linear_iterations;
    if (!system.has_friction() || round + 1 == most_friction_rounds || !potential_.update_friction(u)) break;
  }
  statistics.residual = result.residual;
  statistics.converged = statistics.converged && result.converged;
}

}  // namespace flexcast
