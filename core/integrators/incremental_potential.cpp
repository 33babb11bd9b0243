#include "core/integrators/incremental_potential.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/forces/friction.h"

namespace flexcast {
namespace {

constexpr std::int64_t block = 3 * 1024;  // numbers whose squares are summed by one thread

}  // namespace

void ImplicitStage::start(const System& system, const State& state, double g, double damped_after) {
  length = g;
  end_time = state.time + g;
  base = state.positions;
  base_velocity = state.velocities;
  if (system.has_damping()) damped_at = state.positions + damped_after * state.velocities;
}

void IncrementalPotential::begin(const System& system, const ImplicitStage& stage, VecX& u) {
  system_ = &system;
  stage_ = &stage;
  slip_ = 1e-4 * system.size() * stage.length;
  // Elastic forces suffer from the rounding of positions, inertia from that of the displacement.
  noise_ = 1e-14 * (system.size() * system.stiffness_norm() +
                    system.masses().cwiseProduct(stage.base_velocity).norm() / stage.length);
  constant_norm_ = constant_force().norm();
  base_is_valid_ = false;
  u.setZero(system.dofs());
  if (system.has_handles()) {
    x_ = stage.base;
    system.prescribe(stage.end_time, x_, velocity_ = stage.base_velocity);
    u = x_ - stage.base;
  }
  friction_.clear();
  if (!system.has_friction()) return;
  x_ = stage.base + stage.length * stage.base_velocity.cwiseProduct(system.free()) + u;
  take_friction_at_x();
}

void IncrementalPotential::calc_drift(VecX& drift) const {
  drift = stage_->length * stage_->base_velocity.cwiseProduct(system_->free());
}

MinimizationProblem::Value IncrementalPotential::calc_value(const VecX& u) {
  const double g = stage_->length;
  x_ = stage_->base + u;
  scratch_ = (u - g * stage_->base_velocity).cwiseProduct(system_->free());
  const double kinetic = 0.5 / (g * g) * scratch_.dot(system_->masses().cwiseProduct(scratch_));
  const double elastic = system_->calc_position_dependent_energy(x_);
  const double constant = -constant_force().dot(u);
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
  const double g = stage_->length;
  x_ = stage_->base + u;
  system_->calc_position_dependent(x_, force_);
  damping_power_ = 0.0;
  const bool damped = system_->has_damping();
  if (damped) {
    velocity_ = u / g;
    damping_power_ = system_->calc_damping(stage_->damped_at, velocity_, damping_);
  }
  const VecX &masses = system_->masses(), &free = system_->free(), &constant = constant_force();
  const VecX& drifting = stage_->base_velocity;
  gradient.resize(u.size());
  const std::int64_t blocks = (u.size() + block - 1) / block;
  squares_.resize(static_cast<std::size_t>(blocks));
  parallel_for(blocks, 1, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t b = first; b < end; ++b) {
      Squares squares;
      for (std::int64_t i = b * block; i < std::min<std::int64_t>(u.size(), (b + 1) * block); ++i) {
        const double inertia = masses[i] * (u[i] - g * drifting[i]) * free[i] / (g * g), elastic = force_[i];
        const double damping = damped ? damping_[i] : 0.0;
        force_[i] = elastic + constant[i] + damping;
        gradient[i] = inertia - force_[i] * free[i];
        squares.inertia += inertia * inertia;
        squares.elastic += elastic * elastic;
        squares.damping += damping * damping;
      }
      squares_[static_cast<std::size_t>(b)] = squares;
    }
  });
  Squares all;
  for (const Squares& of : squares_) {
    all.inertia += of.inertia, all.elastic += of.elastic, all.damping += of.damping;
  }
  // Reactions of what is held count among the terms.
  double terms = std::sqrt(all.inertia) + std::sqrt(all.elastic) + constant_norm_ + std::sqrt(all.damping);
  if (!friction_.empty()) add_friction(u, gradient, terms);
  return terms;
}

void IncrementalPotential::add_friction(const VecX& u, VecX& gradient, double& terms) {
  sliding_.setZero(u.size());
  for (const FrictionPoint& point : friction_) {
    block3(sliding_, point.particle) -= calc_friction_potential(point, slip_, block3(u, point.particle)).gradient;
  }
  force_ += sliding_;
  gradient -= sliding_.cwiseProduct(system_->free());
  terms += sliding_.norm();
}

void IncrementalPotential::calc_hessian(const VecX& u, bool exact, BlockMatrix& hessian) {
  const double g = stage_->length;
  if (base_is_valid_) {
    hessian.assign_values(base_matrix_);
  } else {
    scratch_ = system_->masses() / (g * g);
    hessian.set_zero();
    hessian.add_diagonal(scratch_);
    if (system_->has_damping()) {
      system_->add_damping_matrix(stage_->damped_at, 1.0 / g, hessian);
      base_matrix_ = hessian;
      base_is_valid_ = true;
    }
  }
  x_ = stage_->base + u;
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
  x_ = stage_->base + u;
  return take_friction_at_x();
}

bool IncrementalPotential::take_friction_at_x() {
  const auto total = [](const std::vector<FrictionPoint>& points) {
    double sum = 0.0;
    for (const FrictionPoint& point : points) sum += point.limit;
    return sum;
  };
  system_->find_friction_points(x_, found_);
  if (std::abs(total(found_) - total(friction_)) <= 1e-3 * total(found_)) return false;
  friction_.swap(found_);
  return true;
}

void ImplicitSolver::solve(const System& system, StepStatistics& statistics) {
  constexpr int most_friction_rounds = 5;
  potential_.begin(system, stage_, u_);
  NewtonResult result;
  for (int round = 0; round < most_friction_rounds; ++round) {
    potential_.calc_drift(guess_);
    guess_ -= u_.cwiseProduct(system.free());
    result = newton_.minimize(potential_, hessian_, guess_, u_);
    statistics.iterations += result.iterations;
    statistics.linear_iterations += result.linear_iterations;
    if (!system.has_friction() || round + 1 == most_friction_rounds || !potential_.update_friction(u_)) break;
  }
  statistics.residual = result.residual;
  statistics.converged = statistics.converged && result.converged;
}

}  // namespace flexcast
