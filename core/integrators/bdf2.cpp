#include "core/integrators/bdf2.h"

#include <limits>

#include "core/forces/friction.h"
#include "core/integrators/incremental_potential.h"

namespace flexcast {
namespace {

class Bdf2 final : public Integrator {
 public:
  Bdf2(const System& system, const SolverSettings& settings) : solver_(system, settings) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    double power = system.has_damping() ? system.calc_damping(state.positions, state.velocities, force_) : 0.0;
    if (system.has_friction()) power += calc_friction_power(system, state);
    begin_stage(system, h, state);
    solver_.solve(system, statistics);
    statistics.dissipated += 0.5 * h * (power + solver_.calc_dissipated_power());

    last_step_ = h;
    last_positions_ = state.positions;
    last_velocities_ = state.velocities;
    // The impulse of the step is that of the stage with what the base brought along.
    solver_.finish(system, h, {.reach = 1.0, .time = solver_.stage().length, .past = 0.0}, state, statistics);
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

  void limit_iterations(int most) override { solver_.limit_iterations(most); }

 private:
  double calc_friction_power(const System& system, const State& state) {
    double power = 0.0;
    system.find_friction_points(state.positions, friction_);
    for (const FrictionPoint& point : friction_) {
      power += point.limit * calc_tangential(point, block3(state.velocities, point.particle)).norm();
    }
    return power;
  }

  void begin_stage(const System& system, double h, const State& state) {
    ImplicitStage& stage = solver_.stage();
    stage.start(system, state, h, h);
    if (last_step_ == 0.0) return;
    const double w = h / last_step_;
    const double last = w * w / (1.0 + 2.0 * w);  // y* = y_n + last (y_n - y_{n-1})
    stage.length = h * (1.0 + w) / (1.0 + 2.0 * w);
    stage.base += last * system.free().cwiseProduct(state.positions - last_positions_);
    stage.base_velocity += last * system.free().cwiseProduct(state.velocities - last_velocities_);
    // Handles' particles end where and as fast as prescribed: their base is such that u / g is their velocity.
    for (const Handle& handle : system.handles()) {
      const HandleMotion motion = system.calc_motion(handle, stage.end_time);
      for (std::size_t i = 0; i < handle.particles.size(); ++i) {
        block3(stage.base, handle.particles[i]) =
            motion.calc_position(handle.base[i]) - stage.length * motion.calc_velocity(handle.base[i]);
      }
    }
  }

  ImplicitSolver solver_;
  double last_step_ = 0.0;  // s; 0: there is none
  VecX last_positions_, last_velocities_, force_;
  std::vector<FrictionPoint> friction_;
};

}  // namespace

const IntegratorRow bdf2_row{"bdf2",
                             "implicit, second order, damps what it does not resolve",
                             2,
                             true,
                             [](double, double) { return std::numeric_limits<double>::infinity(); },
                             [](const System& system, const SolverSettings& settings) -> std::unique_ptr<Integrator> {
                               return std::make_unique<Bdf2>(system, settings);
                             },
                             {1.0 / 3.0, 1.0 / 3.0}};

}  // namespace flexcast
