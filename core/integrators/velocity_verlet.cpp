#include "core/integrators/velocity_verlet.h"

#include <Eigen/Eigenvalues>

#include "core/integrators/stability.h"

namespace flexcast {
namespace {

class VelocityVerlet final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics&) override {
    const VecX& w = system.inverse_masses();
    if (!conservative_is_valid_) system.calc_conservative(state.positions, conservative_);
    half_ = state.velocities + 0.5 * h * w.cwiseProduct(conservative_);
    if (system.has_damping()) {
      system.calc_damping(state.positions, state.velocities, damping_);
      half_ += 0.5 * h * w.cwiseProduct(damping_);
      system.calc_damping(state.positions, half_, damping_);
      conservative_ += damping_;
    }
    state.velocities += 0.5 * h * w.cwiseProduct(conservative_);
    state.positions += h * half_;

    system.calc_conservative(state.positions, conservative_);
    state.velocities += 0.5 * h * w.cwiseProduct(conservative_);
    if (system.has_damping()) {
      system.calc_damping(state.positions, half_, damping_);
      state.velocities += 0.5 * h * w.cwiseProduct(damping_);
    }
    conservative_is_valid_ = true;
  }

  void invalidate() override { conservative_is_valid_ = false; }

 private:
  VecX conservative_, damping_, half_;
  bool conservative_is_valid_ = false;
};

double calc_stable_step(double omega, double c) {
  const double scale = 1e-3 / (omega + c);  // s
  if (!(omega + c > 0.0)) return std::numeric_limits<double>::infinity();
  return find_stability_limit(scale, [=](double h) {
    // Columns: where (x, v) = (1, 0) and (0, 1) go.
    Eigen::Matrix2d amplification;
    for (int column = 0; column < 2; ++column) {
      const double x = column == 0, v = column == 1;
      const auto acceleration = [=](double at, double speed) { return -omega * omega * at - c * speed; };
      const double half = v + 0.5 * h * acceleration(x, v);
      const double next = x + h * half;
      amplification.col(column) << next, v + 0.5 * h * (acceleration(x, half) + acceleration(next, half));
    }
    return amplification.eigenvalues().cwiseAbs().maxCoeff();
  });
}

}  // namespace

const IntegratorRow velocity_verlet_row{"velocity_verlet",
                                        "explicit, second order; damping from the half-step velocity",
                                        2,
                                        false,
                                        calc_stable_step,
                                        [](const System&, const SolverSettings&) -> std::unique_ptr<Integrator> {
                                          return std::make_unique<VelocityVerlet>();
                                        }};

}  // namespace flexcast
