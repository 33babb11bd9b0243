#include "core/integrators/backward_euler.h"

#include <limits>

#include "core/integrators/incremental_potential.h"

namespace flexcast {
namespace {

class BackwardEuler final : public Integrator {
 public:
  BackwardEuler(const System& system, const SolverSettings& settings) : solver_(system, settings) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    solver_.stage().start(system, state, h, 0.0);
    solver_.solve(system, statistics);
    statistics.dissipated += h * solver_.calc_dissipated_power();
    solver_.finish(system, h, {.reach = 1.0, .time = h, .past = 0.0}, state, statistics);
  }

  void limit_iterations(int most) override { solver_.limit_iterations(most); }

 private:
  ImplicitSolver solver_;
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
    },
    {0.5, 0.5}};

}  // namespace flexcast
