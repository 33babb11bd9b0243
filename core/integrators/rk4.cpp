#include "core/integrators/rk4.h"

#include <complex>

#include "core/integrators/stability.h"

namespace flexcast {
namespace {

class Rk4 final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics&) override {
    const VecX& w = system.inverse_masses();
    const VecX& x = state.positions;
    const VecX& v = state.velocities;
    system.calc_force(x, v, force_);
    a1_ = w.cwiseProduct(force_);
    v2_ = v + 0.5 * h * a1_;
    at_ = x + 0.5 * h * v;
    system.calc_force(at_, v2_, force_);
    a2_ = w.cwiseProduct(force_);
    v3_ = v + 0.5 * h * a2_;
    at_ = x + 0.5 * h * v2_;
    system.calc_force(at_, v3_, force_);
    a3_ = w.cwiseProduct(force_);
    v4_ = v + h * a3_;
    at_ = x + h * v3_;
    system.calc_force(at_, v4_, force_);
    state.positions += h / 6.0 * (v + 2.0 * v2_ + 2.0 * v3_ + v4_);
    state.velocities += h / 6.0 * (a1_ + 2.0 * a2_ + 2.0 * a3_ + w.cwiseProduct(force_));
  }

 private:
  VecX force_, a1_, a2_, a3_, v2_, v3_, v4_, at_;
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

}  // namespace

const IntegratorRow rk4_row{
    "rk4",
    "explicit, fourth order, four force evaluations a step",
    4,
    false,
    calc_stable_step,
    [](const System&, const SolverSettings&) -> std::unique_ptr<Integrator> { return std::make_unique<Rk4>(); }};

}  // namespace flexcast
