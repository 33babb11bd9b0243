#include "core/integrators/symplectic_euler.h"

#include <cmath>

#include "core/integrators/handle_work.h"
#include "core/integrators/particle_passes.h"

namespace flexcast {
namespace {

class SymplecticEuler final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    step_from(system, h, state, state, statistics);
  }
  void step_from(const System& system, double h, const State& from, State& to, StepStatistics& statistics) override {
    statistics.dissipated += h * system.calc_force(from.positions, from.velocities, force_);
    passes_.kick_and_drift(system, {h, h}, force_, from, to, statistics);
    move_handles(system, from.time + h, h, force_, to.positions, to.velocities, statistics);
  }

 private:
  VecX force_;
  ParticlePasses passes_;
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
                                         },
                                         {0.5, -0.5}};

}  // namespace flexcast
