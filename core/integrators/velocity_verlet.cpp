#include "core/integrators/velocity_verlet.h"

#include <Eigen/Eigenvalues>

#include "core/integrators/stability.h"
#include "core/integrators/velocity_change.h"

namespace flexcast {
namespace {

class VelocityVerlet final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    if (!conservative_is_valid_) system.calc_conservative(state.positions, conservative_);
    if (system.has_damping()) {
      system.calc_damping(state.positions, state.velocities, force_);
      force_ += conservative_;
      predicted_ = state.velocities + 0.5 * h * system.inverse_masses().cwiseProduct(force_);
      statistics.dissipated += 0.5 * h * system.calc_damping(state.positions, predicted_, force_);
      force_ += conservative_;
    } else {
      force_ = conservative_;
    }
    VelocityChange first(system, 0.5 * h, force_, state.velocities, statistics);
    kick(system, 0.5 * h, state, statistics);
    first.close(state.velocities);
    state.positions += h * state.velocities;

    VelocityChange of_handles(system, 0.0, force_, state.velocities, statistics);
    system.prescribe(state.time + h, state.positions, state.velocities);
    of_handles.close(state.velocities);
    system.calc_conservative(state.positions, conservative_);
    conservative_is_valid_ = true;
    if (system.has_damping()) {
      statistics.dissipated += 0.5 * h * system.calc_damping(state.positions, state.velocities, force_);
      force_ += conservative_;
    } else {
      force_ = conservative_;
    }
    VelocityChange second(system, 0.5 * h, force_, state.velocities, statistics);
    kick(system, 0.5 * h, state, statistics);
    second.close(state.velocities);
  }

  void invalidate() override { conservative_is_valid_ = false; }

 private:
  void kick(const System& system, double h, State& state, StepStatistics& statistics) {
    state.velocities += h * system.inverse_masses().cwiseProduct(force_);
    if (system.has_friction()) system.apply_friction(h, state.positions, force_, state.velocities, statistics);
  }

  VecX conservative_, force_, predicted_;
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
      const double half = v + 0.5 * h * acceleration(x, v + 0.5 * h * acceleration(x, v));
      const double next = x + h * half;
      amplification.col(column) << next, half + 0.5 * h * acceleration(next, half);
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
