#include "core/integrators/backward_euler.h"

#include <limits>

#include "core/integrators/incremental_potential.h"
#include "core/integrators/velocity_change.h"

namespace flexcast {
namespace {

class BackwardEuler final : public Integrator {
 public:
  BackwardEuler(const System& system, const SolverSettings& settings) : solver_(system, settings) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    stage_.length = h;
    stage_.end_time = state.time + h;
    stage_.base = state.positions;
    stage_.base_velocity = state.velocities;
    if (system.has_damping()) stage_.damped_at = state.positions;
    solver_.solve(system, stage_, u_, statistics);
    statistics.dissipated += h * solver_.calc_dissipated_power(u_);

    force_ = solver_.calc_effective_force();
    VelocityChange change(system, h, force_, state.velocities, statistics);
    state.positions += u_;
    state.velocities = u_ / h;
    system.prescribe(stage_.end_time, state.positions, state.velocities);
    change.close(state.velocities);
  }

 private:
  ImplicitSolver solver_;
  ImplicitStage stage_;
  VecX u_, force_;
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
