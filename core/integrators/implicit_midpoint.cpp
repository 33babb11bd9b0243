#include "core/integrators/implicit_midpoint.h"

#include <limits>

#include "core/integrators/incremental_potential.h"

namespace flexcast {
namespace {

class ImplicitMidpoint final : public Integrator {
 public:
  ImplicitMidpoint(const System& system, const SolverSettings& settings) : solver_(system, settings) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    solver_.stage().start(system, state, 0.5 * h, 0.5 * h);
    solver_.solve(system, statistics);
    statistics.dissipated += h * solver_.calc_dissipated_power();
    solver_.finish(system, h, {.reach = 2.0, .time = 0.25 * h, .past = 1.0}, state, statistics);
  }

  void limit_iterations(int most) override { solver_.limit_iterations(most); }

 private:
  ImplicitSolver solver_;
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
    },
    {1.0 / 12.0, 1.0 / 12.0}};

}  // namespace flexcast
