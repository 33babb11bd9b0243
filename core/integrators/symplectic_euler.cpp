#include "core/integrators/symplectic_euler.h"

#include <cmath>

#include "core/integrators/velocity_change.h"

namespace flexcast {
namespace {

class SymplecticEuler final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    statistics.dissipated += h * system.calc_force(state.positions, state.velocities, force_);
    VelocityChange change(system, h, force_, state.velocities, statistics);
    state.velocities += h * system.inverse_masses().cwiseProduct(force_);
    if (system.has_friction()) system.apply_friction(h, state.positions, force_, state.velocities, statistics);
    state.positions += h * state.velocities;
    system.prescribe(state.time + h, state.positions, state.velocities);
    change.close(state.velocities);
  }

 private:
  VecX force_;
};

// omega h < 2 (sqrt(1 + z^2) - z) with z = c / (2 omega), written so that nothing cancels and omega may be zero.
double calc_stable_step(double omega, double c) {
  return 4.0 / (c + std::sqrt(c * c + 4.0 * omega * omega));
}

}  // namespace

const IntegratorRow symplectic_euler_row{"symplectic_euler",
                                         "explicit, the default: new velocities move the particles",
                                         1,
                                         false,
                                         calc_stable_step,
                                         [](const System&, const SolverSettings&) -> std::unique_ptr<Integrator> {
                                           return std::make_unique<SymplecticEuler>();
                                         }};

}  // namespace flexcast
