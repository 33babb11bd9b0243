#include "core/integrators/xpbd.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <numeric>

#include "core/integrators/incremental_potential.h"

namespace flexcast {
namespace {

class Xpbd final : public Integrator {
 public:
  Xpbd(const System& system, const SolverSettings& settings) : settings_(settings) {
    all_.resize(static_cast<std::size_t>(system.dofs() / 3));
    std::iota(all_.begin(), all_.end(), 0);
  }

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    predict(system, h, state);
    for (int i = 0; i < sweeps_; ++i) sweep(system, h, state.positions);
    finish(system, h, state, statistics);
  }

  void limit_iterations(int most) override {
    sweeps_ = most > 0 ? std::min(most, settings_.iterations) : settings_.iterations;
  }

 private:
  // Where the particles go without constraints, u_ from where they are; what damps against the resting world adds to
  // their inertia.
  void predict(const System& system, double h, const State& state) {
    system.calc_constant(force_);
    weights_ = system.inverse_masses();
    velocity_ = state.velocities;
    std::fill(added_inertia_.begin(), added_inertia_.end(), Mat3::Zero());
    for (const Force* force : system.active_forces()) {
      if (!force->has_damping() || force->constraint_count() > 0) continue;
      added_inertia_.resize(all_.size(), Mat3::Zero());
      unused_.assign(all_.size(), Vec3::Zero());
      force->add_damping_blocks(state.positions, state.velocities, h, all_, unused_, added_inertia_);
    }
    for (std::size_t i = 0; i < added_inertia_.size(); ++i) {
      const auto particle = static_cast<std::int64_t>(i);
      const Vec3 ratio =
          (Vec3::Ones() + block3(weights_, particle).cwiseProduct(added_inertia_[i].diagonal())).cwiseInverse();
      block3(weights_, particle) = block3(weights_, particle).cwiseProduct(ratio);
      block3(velocity_, particle) = block3(velocity_, particle).cwiseProduct(ratio);
    }
    u_ = h * (velocity_ + h * weights_.cwiseProduct(force_)).cwiseProduct(system.free());
    if (system.has_handles()) {
      x_ = state.positions;
      system.prescribe(state.time + h, x_, velocity_);
      u_ += (x_ - state.positions).cwiseProduct(VecX::Ones(u_.size()) - system.free());
    }
    lambdas_.resize(system.active_forces().size());
    for (std::size_t k = 0; k < lambdas_.size(); ++k) {
      lambdas_[k].assign(static_cast<std::size_t>(system.active_forces()[k]->constraint_count()), 0.0);
    }
  }

  void sweep(const System& system, double h, const VecX& start) {
    const ConstraintSweep sweep{h, start, weights_};
    for (std::size_t k = 0; k < lambdas_.size(); ++k) {
      if (!lambdas_[k].empty()) system.active_forces()[k]->sweep_constraints(sweep, lambdas_[k], u_);
    }
  }

  void finish(const System& system, double h, State& state, StepStatistics& statistics) {
    statistics.iterations += sweeps_;
    measure_residual(system, h, state, statistics);
    statistics.dissipated += h * potential_.calc_dissipated_power(u_);
    passes_.follow(system, h, {.reach = 1.0, .time = h, .past = 0.0}, stage_.base, u_, potential_.force(), state,
                   statistics);
  }

  // How far from backward Euler the sweeps ended.
  void measure_residual(const System& system, double h, const State& state, StepStatistics& statistics) {
    stage_.start(system, state, h, 0.0);
    potential_.begin(system, stage_, guess_);
    if (system.has_friction()) potential_.update_friction(u_);
    const double terms = potential_.calc_gradient(u_, gradient_);
    statistics.residual = terms > 0.0 ? gradient_.norm() / terms : 0.0;
    statistics.converged = statistics.converged && statistics.residual <= settings_.newton_tolerance;
  }

  SolverSettings settings_;
  int sweeps_ = settings_.iterations;
  IncrementalPotential potential_;
  ImplicitStage stage_;
  ParticlePasses passes_;
  VecX force_, weights_, velocity_, x_, u_, guess_, gradient_;
  std::vector<std::vector<double>> lambdas_;  // per active force
  std::vector<std::int32_t> all_;             // every particle
  std::vector<Mat3> added_inertia_;           // kg, per particle; empty without drag
  std::vector<Vec3> unused_;
};

}  // namespace

const IntegratorRow xpbd_row{"xpbd",
                             "position-based with compliant constraints: fast, with many substeps and few iterations",
                             0,
                             true,
                             [](double, double) { return std::numeric_limits<double>::infinity(); },
                             [](const System& system, const SolverSettings& settings) -> std::unique_ptr<Integrator> {
                               return std::make_unique<Xpbd>(system, settings);
                             }};

}  // namespace flexcast
