#include "core/integrators/symplectic_euler.h"

#include <cmath>

namespace flexcast {
namespace {

class SymplecticEuler final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics&) override {
    system.calc_force(state.positions, state.velocities, force_);
    state.velocities += h * system.inverse_masses().cwiseProduct(force_);
    state.positions += h * state.velocities;
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
