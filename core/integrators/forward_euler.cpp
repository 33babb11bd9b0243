#include "core/integrators/forward_euler.h"

#include <cmath>

#include "core/integrators/handle_work.h"
#include "core/integrators/linear_motion.h"
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

// The least damped mode can be any of them, and only all eigenvalues tell.
double calc_coupled_stable_step(LinearMotion& motion, double limit) {
  const VecXc lambdas = calc_eigenvalues(motion);
  if (lambdas.size() == 0) return limit;
  double exact = std::numeric_limits<double>::infinity();
  for (const auto& lambda : lambdas) exact = std::min(exact, -2.0 * lambda.real() / std::norm(lambda));
  return std::max(limit, (1.0 - 1e-6) * exact);
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
                                      {-0.5, -0.5},
                                      calc_coupled_stable_step};

}  // namespace flexcast
