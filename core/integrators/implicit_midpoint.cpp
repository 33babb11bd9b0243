#include "core/integrators/implicit_midpoint.h"

#include <limits>

#include "core/integrators/incremental_potential.h"
#include "core/integrators/velocity_change.h"

namespace flexcast {
namespace {

class ImplicitMidpoint final : public Integrator {
 public:
  ImplicitMidpoint(const System& system, const SolverSettings& settings) : solver_(system, settings) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    stage_.length = 0.5 * h;
    stage_.end_time = state.time + 0.5 * h;
    stage_.base = state.positions;
    stage_.base_velocity = state.velocities;
    if (system.has_damping()) stage_.damped_at = state.positions + 0.5 * h * state.velocities;
    solver_.solve(system, stage_, u_, statistics);
    statistics.dissipated += h * solver_.calc_dissipated_power(u_);

    force_ = solver_.calc_effective_force();
    VelocityChange change(system, h, force_, state.velocities, statistics);
    state.positions += 2.0 * u_;
    state.velocities = 4.0 / h * u_ - state.velocities;
    system.prescribe(state.time + h, state.positions, state.velocities);
    change.close(state.velocities);
  }

 private:
  ImplicitSolver solver_;
  ImplicitStage stage_;
  VecX u_, force_;
};

}  // namespace

const IntegratorRow implicit_midpoint_row{
    "implicit_midpoint",
    "implicit, second order: keeps the energy, rings where it does not resolve",
    2,
    true,
    [](double, double) { return std::numeric_limits<double>::infinity(); },
    [](const System& system, const SolverSettings& settings) -> std::unique_ptr<Integrator> {
      return std::make_unique<ImplicitMidpoint>(system, settings);
    }};

}  // namespace flexcast
