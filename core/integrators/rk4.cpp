#include "core/integrators/rk4.h"

#include <complex>

#include "core/integrators/handle_work.h"
#include "core/integrators/linear_motion.h"
#include "core/integrators/particle_passes.h"
#include "core/integrators/stability.h"

namespace flexcast {
namespace {

class Rk4 final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    const VecX& v = state.velocities;
    double power = system.calc_force(state.positions, v, f1_);
    make_stage(system, 0.5 * h, state, v, f1_, v2_);
    power += 2.0 * system.calc_force(at_, v2_, f2_);
    make_stage(system, 0.5 * h, state, v2_, f2_, v3_);
    power += 2.0 * system.calc_force(at_, v3_, f3_);
    make_stage(system, h, state, v3_, f3_, v4_);
    power += system.calc_force(at_, v4_, f4_);
    statistics.dissipated += h / 6.0 * power;

    f1_ = (f1_ + 2.0 * f2_ + 2.0 * f3_ + f4_) / 6.0;
    v2_ = (v + 2.0 * v2_ + 2.0 * v3_ + v4_) / 6.0;
    passes_.drift(h, v2_, state.positions, state.positions, statistics);
    passes_.kick(system, h, f1_, at_, v, state.velocities, statistics);
    move_handles(system, state.time + h, h, f1_, state.positions, state.velocities, statistics);
  }

 private:
  // The next stage, h after the start: positions at_ moved with `velocities`, velocities `to` changed by `force`.
  void make_stage(const System& system, double h, const State& state, const VecX& velocities, const VecX& force,
                  VecX& to) {
    StepStatistics unused;
    passes_.kick(system, h, force, state.positions, state.velocities, to, unused);
    at_ = state.positions + h * velocities;
    system.prescribe(state.time + h, at_, to);
  }

  ParticlePasses passes_;
  VecX f1_, f2_, f3_, f4_, v2_, v3_, v4_, at_;
};

// |R(h lambda)| <= 1 with R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24 and lambda^2 + c lambda + omega^2 = 0.
double calc_stable_step(double omega, double c) {
  if (!(omega + c > 0.0)) return std::numeric_limits<double>::infinity();
  const std::complex<double> root = std::sqrt(std::complex<double>(0.25 * c * c - omega * omega));
  const std::complex<double> lambdas[] = {-0.5 * c + root, -0.5 * c - root};
  return find_stability_limit(1e-3 / (omega + c), [&](double h) {
    double largest = 0.0;
    for (const auto& lambda : lambdas) {
      const std::complex<double> z = h * lambda;
      largest = std::max(largest, std::abs(1.0 + z * (1.0 + z * (0.5 + z * (1.0 / 6.0 + z / 24.0)))));
    }
    return largest;
  });
}

double calc_coupled_stable_step(LinearMotion& motion, double limit) {
  const VecXc lambdas = calc_eigenvalues(motion);
  if (lambdas.size() == 0) return limit;
  double exact = std::numeric_limits<double>::infinity();
  for (const auto& lambda : lambdas) {
    const bool real = lambda.imag() == 0.0;
    exact = std::min(
        exact, real ? calc_stable_step(0.0, -lambda.real()) : calc_stable_step(std::abs(lambda), -2.0 * lambda.real()));
  }
  return std::max(limit, (1.0 - 1e-6) * exact);
}

}  // namespace

const IntegratorRow rk4_row{
    "rk4",
    "explicit, fourth order, four force evaluations a step",
    4,
    false,
    calc_stable_step,
    [](const System&, const SolverSettings&) -> std::unique_ptr<Integrator> { return std::make_unique<Rk4>(); },
    {},
    calc_coupled_stable_step};

}  // namespace flexcast
