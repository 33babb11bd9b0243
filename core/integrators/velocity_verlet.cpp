#include "core/integrators/velocity_verlet.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/integrators/handle_work.h"
#include "core/integrators/lanczos.h"
#include "core/integrators/linear_motion.h"
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

// An eigenvalue of the step reaches -1 where P S w = w has a solution, with d = h D / 2, S = h^2 K / 4 + d and
// P = 1 - d + d^2 / 2 (x' = -x and w' = -w put into the scheme, w the velocity of the half step).
double calc_growth(LinearMotion& motion, double h) {
  VecX once, twice;
  const auto weigh = [&](const VecX& q, VecX& Sq) {
    Sq.setZero(q.size());
    motion.add_stiffness(0.25 * h * h, q, Sq);
    motion.add_damping(0.5 * h, q, Sq);
  };
  const auto apply = [&](const VecX& q, VecX& Pq) {
    once.setZero(q.size());
    twice.setZero(q.size());
    motion.add_damping(0.5 * h, q, once);
    motion.add_damping(0.5 * h, once, twice);
    Pq = q - once + 0.5 * twice;
  };
  return calc_largest_eigenvalue({motion.size(), weigh, apply});
}

// P S is symmetric in the product by S, and its largest eigenvalue grows with a power of h between 1 and 3: no step of
// this search passes the limit.
double calc_coupled_stable_step(LinearMotion& motion, double h) {
  for (int i = 0; i < 4; ++i) {
    const double growth = calc_growth(motion, h);
    if (!(growth > 0.0)) break;
    h /= growth > 1.0 ? growth : std::cbrt(growth);
    if (growth <= 1.0 && growth > 0.97) break;
  }
  return h;
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
                                        {-1.0 / 6.0, 1.0 / 12.0},
                                        calc_coupled_stable_step};

}  // namespace flexcast
