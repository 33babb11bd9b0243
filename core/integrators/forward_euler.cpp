#include "core/integrators/forward_euler.h"

#include <cmath>

#include "core/integrators/velocity_change.h"

namespace flexcast {
namespace {

class ForwardEuler final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    statistics.dissipated += h * system.calc_force(state.positions, state.velocities, force_);
    VelocityChange change(system, h, force_, state.velocities, statistics);
    start_ = state.positions;
    state.positions += h * state.velocities;
    state.velocities += h * system.inverse_masses().cwiseProduct(force_);
    if (system.has_friction()) system.apply_friction(h, start_, force_, state.velocities, statistics);
    system.prescribe(state.time + h, state.positions, state.velocities);
    change.close(state.velocities);
  }

 private:
  VecX force_, start_;
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
                                      }};

}  // namespace flexcast
