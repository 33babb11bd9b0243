#include "core/integrators/velocity_verlet.h"

#include <Eigen/Eigenvalues>

#include "core/integrators/handle_work.h"
#include "core/integrators/particle_passes.h"
#include "core/integrators/stability.h"

namespace flexcast {
namespace {

class VelocityVerlet final : public Integrator {
 public:
  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    step_from(system, h, state, state, statistics);
  }

  void step_from(const System& system, double h, const State& from, State& to, StepStatistics& statistics) override {
    const double half = 0.5 * h, end = from.time + h;
    if (!conservative_is_valid_) system.calc_conservative(from.positions, conservative_);
    if (system.has_damping()) predict(system, half, from);
    const VecX& first = add_damping(system, half, from.positions, predicted_, statistics);
    statistics.handle_work -= half * calc_handle_power(system, first, from.velocities);
    passes_.kick_and_drift(system, {half, h}, first, from, to, statistics);
    move_handles(system, end, 0.0, first, to.positions, to.velocities, statistics);

    system.calc_conservative(to.positions, conservative_);
    conservative_is_valid_ = true;
    const VecX& second = add_damping(system, half, to.positions, to.velocities, statistics);
    statistics.handle_work -= half * calc_handle_power(system, second, to.velocities);
    passes_.kick(system, half, second, to.positions, to.velocities, to.velocities, statistics);
  }

  void invalidate() override { conservative_is_valid_ = false; }

 private:
  // The velocities at the half step, for the damping there.
  void predict(const System& system, double half, const State& from) {
    system.calc_damping(from.positions, from.velocities, force_);
    force_ += conservative_;
    predicted_ = from.velocities + half * system.inverse_masses().cwiseProduct(force_);
  }

  // All forces: the conservative ones, and what damps at x and v for `h` seconds.
  const VecX& add_damping(const System& system, double h, const VecX& x, const VecX& v, StepStatistics& statistics) {
    if (!system.has_damping()) return conservative_;
    statistics.dissipated += h * system.calc_damping(x, v, force_);
    force_ += conservative_;
    return force_;
  }

  ParticlePasses passes_;
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
                                        },
                                        {-1.0 / 6.0, 1.0 / 12.0}};

}  // namespace flexcast
