#include "core/integrators/quasi_static.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "core/materials/polar.h"
#include "core/solvers/newton.h"

namespace flexcast {
namespace {

// A body's mass, centre and inertia about it.
struct RigidProperties {
  double mass = 0.0;
  Vec3 center = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

RigidProperties calc_rigid_properties(const System& system, const Body& body, const VecX& x) {
  RigidProperties rigid;
  for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i) {
    const double mass = block3(system.masses(), i)[0];
    rigid.mass += mass;
    rigid.center += mass * block3(x, i);
  }
  rigid.center /= rigid.mass;
  for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i) {
    const Vec3 arm = block3(x, i) - rigid.center;
    rigid.inertia += block3(system.masses(), i)[0] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  return rigid;
}

// U(x0 + u) without what constant forces on free bodies would do to their rigid motion.
class StaticPotential final : public MinimizationProblem {
 public:
  void begin(const System& system, double end_time, const State& state, VecX& u) {
    system_ = &system;
    start_ = &state.positions;
    shift_ = smallest_shift;
    noise_ = 1e-14 * system.size() * system.stiffness_norm();
    u.setZero(system.dofs());
    if (system.has_handles()) {
      x_ = state.positions;
      unused_ = state.velocities;
      system.prescribe(end_time, x_, unused_);
      u = x_ - state.positions;
    }
    constant_ = system.constant_force();
    system.find_free_bodies(free_bodies_);
    for (const Body* body : free_bodies_) relieve(*body);
  }

  Value calc_value(const VecX& u) override {
    x_ = *start_ + u;
    const double elastic = system_->calc_position_dependent_energy(x_), constant = -constant_.dot(u);
    return {elastic + constant, std::abs(elastic) + std::abs(constant)};
  }

  double calc_gradient(const VecX& u, VecX& gradient) override {
    x_ = *start_ + u;
    system_->calc_position_dependent(x_, force_);
    // Held particles count: where nothing else pulls, their reactions are what forces are compared with.
    const double terms = force_.norm() + constant_.norm();
    force_ += constant_;
    gradient = -force_.cwiseProduct(system_->free());
    return terms;
  }

  void calc_hessian(const VecX& u, bool exact, BlockMatrix& hessian) override {
    x_ = *start_ + u;
    hessian.set_zero();
    system_->add_stiffness(x_, 1.0, exact ? Tangent::exact : Tangent::positive_semidefinite, hessian);
    largest_rate_ = 0.0;
    for (std::int32_t i = 0; i < hessian.rows(); ++i) {
      const double rate = hessian.diagonal(i).trace() / block3(system_->masses(), i)[0];
      largest_rate_ = std::max(largest_rate_, std::abs(rate));
    }
    if (largest_rate_ == 0.0) largest_rate_ = 1.0;
    diagonal_ = shift_ * largest_rate_ * system_->masses();
    hessian.add_diagonal(diagonal_);
    hessian.hold(system_->free());
  }

  double calc_noise() const override { return noise_; }
  int patience() const override { return 2; }

  bool adapt(double length) override {
    if (length == 1.0) {
      shift_ = std::max(smallest_shift, 0.1 * shift_);
      return true;
    }
    if (length == 0.0 && shift_ >= largest_shift) return false;
    shift_ = std::min(largest_shift, (length > 0.05 ? 4.0 : 100.0) * shift_);
    return true;
  }

  // N, all forces at the last u, held particles included.
  const VecX& force() const { return force_; }
  std::span<const Body* const> free_bodies() const { return free_bodies_; }

 private:
  static constexpr double smallest_shift = 1e-11, largest_shift = 1e3;

  void relieve(const Body& body) {
    const RigidProperties rigid = calc_rigid_properties(*system_, body, *start_);
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i) {
      force += block3(constant_, i);
      torque += (block3(*start_, i) - rigid.center).cross(Vec3(block3(constant_, i)));
    }
    const Vec3 turning = rigid.inertia.completeOrthogonalDecomposition().solve(torque);
    for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i) {
      const Vec3 arm = block3(*start_, i) - rigid.center;
      block3(constant_, i) -= block3(system_->masses(), i)[0] * (force / rigid.mass + turning.cross(arm));
    }
  }

  const System* system_ = nullptr;
  const VecX* start_ = nullptr;
  double shift_ = smallest_shift, largest_rate_ = 0.0;
  double noise_ = 0.0;  // N
  VecX constant_, x_, force_, diagonal_, unused_;
  std::vector<const Body*> free_bodies_;
};

class QuasiStatic final : public Integrator {
 public:
  QuasiStatic(const System& system, const SolverSettings& settings)
      : newton_(with_line_search(settings), system.rest_positions()), hessian_(system.make_matrix()) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    potential_.begin(system, state.time + h, state, u_);
    system.calc_conservative(state.positions, start_force_);
    const double start_potential = system.calc_potential(state.positions);
    const double stopped = system.calc_kinetic(state.velocities);
    no_guess_.setZero(u_.size());
    const NewtonResult result = newton_.minimize(potential_, hessian_, no_guess_, u_);
    statistics.iterations += result.iterations;
    statistics.linear_iterations += result.linear_iterations;
    statistics.residual = result.residual;
    statistics.converged = statistics.converged && result.converged;

    // What handles put in, by the trapezoidal rule of what they hold against; the rest relaxed.
    work_ = 0.5 * (start_force_ + potential_.force()).cwiseProduct(u_);
    const double handle_work = work_.dot(system.free()) - work_.sum();
    start_ = state.positions;
    state.positions += u_;
    const double released = handle_work - (system.calc_potential(state.positions) - start_potential);
    statistics.handle_work += handle_work;
    statistics.force_work -= handle_work + stopped;
    statistics.dissipated += std::max(released, 0.0) + stopped;

    for (const Body* body : potential_.free_bodies()) align(system, *body, start_, state.positions);
    system.prescribe(state.time + h, state.positions, state.velocities);
    state.velocities.setZero();
    if (!is_publishable(state)) statistics.force_work = std::numeric_limits<double>::quiet_NaN();
  }

 private:
  static SolverSettings with_line_search(SolverSettings settings) {
    settings.newton_iterations = std::max(2, settings.newton_iterations);
    return settings;
  }

  // Undoes the mean motion of a body that nothing holds; its energy does not feel it (linear: only the translation).
  static void align(const System& system, const Body& body, const VecX& from, VecX& to) {
    const Vec3 start = calc_rigid_properties(system, body, from).center;
    const Vec3 end = calc_rigid_properties(system, body, to).center;
    Mat3 covariance = Mat3::Zero();
    for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i) {
      covariance += block3(system.masses(), i)[0] * (block3(from, i) - start) * (block3(to, i) - end).transpose();
    }
    const Mat3 R = body.is_fem() && body.law->small_strain ? Mat3(Mat3::Identity()) : calc_rotation(covariance);
    for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i) {
      block3(to, i) = start + R * (block3(to, i) - end);
    }
  }

  StaticPotential potential_;
  NewtonSolver newton_;
  BlockMatrix hessian_;
  VecX u_, no_guess_, start_, start_force_, work_;
};

}  // namespace

const IntegratorRow quasi_static_row{
    "quasi_static",
    "equilibrium at every step, without inertia",
    0,
    true,
    [](double, double) { return std::numeric_limits<double>::infinity(); },
    [](const System& system, const SolverSettings& settings) -> std::unique_ptr<Integrator> {
      return std::make_unique<QuasiStatic>(system, settings);
    }};

}  // namespace flexcast
