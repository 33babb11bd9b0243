#include "core/integrators/forward_euler.h"

#include <cmath>

#include "core/integrators/handle_work.h"
#include "core/integrators/particle_passes.h"

namespace flexcast {
namespace {

class ForwardEuler final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    step_from(system, h, state, state, statistics);
  }
  void step_from(const System& system, double h, const State& from, State& to, StepStatistics& statistics) override {
    statistics.dissipated += h * system.calc_force(from.positions, from.velocities, force_);
    passes_.drift_and_kick(system, h, force_, from, to, statistics);
    move_handles(system, from.time + h, h, force_, to.positions, to.velocities, statistics);
  }

 private:
  VecX force_;
  ParticlePasses passes_;
};

// The eigenvalues of the amplification matrix are 1 + h lambda with lambda^2 + c lambda + omega^2 = 0.
double calc_stable_step(double omega, double c) {
  const double discriminant = c * c - 4.0 * omega * omega;
  if (discriminant < 0.0) return c / (omega * omega);
  return 4.0 / (c + std::sqrt(discriminant));
}

}  // namespace

const IntegratorRow forward_euler_row{"forward_euler",
                                      "explicit, for comparison: unstable without damping",
                                      1,
                                      false,
                                      calc_stable_step,
                                      [](const System&, const SolverSettings&) -> std::unique_ptr<Integrator> {
                                        return std::make_unique<ForwardEuler>();
                                      },
                                      {-0.5, -0.5}};

}  // namespace flexcast
