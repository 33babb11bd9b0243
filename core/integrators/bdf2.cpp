#include "core/integrators/bdf2.h"

#include <limits>

#include "core/forces/friction.h"
#include "core/integrators/incremental_potential.h"
#include "core/integrators/velocity_change.h"

namespace flexcast {
namespace {

class Bdf2 final : public Integrator {
 public:
  Bdf2(const System& system, const SolverSettings& settings) : solver_(system, settings) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    double power = system.has_damping() ? system.calc_damping(state.positions, state.velocities, force_) : 0.0;
    if (system.has_friction()) power += calc_friction_power(system, state);
    begin_stage(system, h, state);
    solver_.solve(system, stage_, u_, statistics);
    statistics.dissipated += 0.5 * h * (power + solver_.calc_dissipated_power(u_));

    last_step_ = h;
    last_positions_ = state.positions;
    last_velocities_ = state.velocities;
    state.positions = stage_.base + u_;
    state.velocities = u_ / stage_.length;
    // The impulse of the step: of the stage where free, with what the base brought along; of the forces where held.
    force_ = solver_.calc_effective_force();
    force_ +=
        system.free().cwiseProduct(system.masses().cwiseProduct(state.velocities - last_velocities_) / h - force_);
    VelocityChange change(system, h, force_, last_velocities_, statistics);
    system.prescribe(state.time + h, state.positions, state.velocities);
    change.close(state.velocities);
  }

  void invalidate() override { last_step_ = 0.0; }

  VecX history() const override {
    if (last_step_ == 0.0) return {};
    VecX history(1 + 2 * last_positions_.size());
    history << last_step_, last_positions_, last_velocities_;
    return history;
  }
  void set_history(const VecX& history) override {
    last_step_ = history.size() > 0 ? history[0] : 0.0;
    if (last_step_ == 0.0) return;
    const Eigen::Index n = (history.size() - 1) / 2;
    last_positions_ = history.segment(1, n);
    last_velocities_ = history.segment(1 + n, n);
  }

 private:
  static double calc_friction_power(const System& system, const State& state) {
    double power = 0.0;
    for (const FrictionPoint& point : system.find_friction_points(state.positions)) {
      power += point.limit * calc_tangential(point, block3(state.velocities, point.particle)).norm();
    }
    return power;
  }

  void begin_stage(const System& system, double h, const State& state) {
    stage_.length = h;
    stage_.end_time = state.time + h;
    stage_.base = state.positions;
    stage_.base_velocity = state.velocities;
    if (system.has_damping()) stage_.damped_at = state.positions + h * state.velocities;
    if (last_step_ == 0.0) return;
    const double w = h / last_step_;
    const double last = w * w / (1.0 + 2.0 * w);  // y* = y_n + last (y_n - y_{n-1})
    stage_.length = h * (1.0 + w) / (1.0 + 2.0 * w);
    stage_.base += last * system.free().cwiseProduct(state.positions - last_positions_);
    stage_.base_velocity += last * system.free().cwiseProduct(state.velocities - last_velocities_);
    if (!system.has_handles()) return;
    // Handles' particles end where and as fast as prescribed: their base is such that u / g is their velocity.
    VecX x = state.positions, v = state.velocities;
    system.prescribe(stage_.end_time, x, v);
    const VecX held = VecX::Ones(x.size()) - system.free();
    stage_.base += held.cwiseProduct(x - stage_.length * v - stage_.base);
  }

  ImplicitSolver solver_;
  ImplicitStage stage_;
  double last_step_ = 0.0;  // s; 0: there is none
  VecX last_positions_, last_velocities_, u_, force_;
};

}  // namespace

const IntegratorRow bdf2_row{"bdf2",
                             "implicit, second order, damps what it does not resolve",
                             2,
                             true,
                             [](double, double) { return std::numeric_limits<double>::infinity(); },
                             [](const System& system, const SolverSettings& settings) -> std::unique_ptr<Integrator> {
                               return std::make_unique<Bdf2>(system, settings);
                             }};

}  // namespace flexcast
