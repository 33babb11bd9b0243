// What an implicit step minimises, as a function of the displacement u from a base x*:
//   1/2 (u - g v*)^T M (u - g v*) / g^2 + U(x* + u) + 1/2 u^T D u / g + friction(u),
// whose stationary point is the implicit Euler step of length g from (x*, v*) to x* + u with the velocity u / g. Every
// implicit scheme here is such a step with a base, velocity and length of its own. D is frozen: damping is linear in
// the new velocity, with the directions of given positions. Friction uses normal forces of the last round.
// Sources: R. Radovitzky, M. Ortiz, Comput. Methods Appl. Mech. Engrg. 172 (1999) 203-240; J. Martin et al.,
// Example-based elastic materials, ACM TOG 30(4), 2011.
#pragma once

#include "core/forces/system.h"
#include "core/integrators/integrator.h"
#include "core/integrators/particle_passes.h"
#include "core/solvers/newton.h"

namespace flexcast {

// One implicit Euler step.
struct ImplicitStage {
  double length = 0.0;    // g, s
  double end_time = 0.0;  // s, where handles are then
  VecX base;              // x*, m
  VecX base_velocity;     // v*, m/s
  VecX damped_at;         // m, where D is taken; used when the system has damping

  // From the state as it is; damping takes its directions where the particles are `damped_after` seconds later.
  void start(const System& system, const State& state, double g, double damped_after);
};

// Squared norms of the terms of a gradient, N^2.
struct Squares {
  double inertia = 0.0, elastic = 0.0, damping = 0.0;
};

class IncrementalPotential final : public MinimizationProblem {
 public:
  // Starts a stage; u becomes a first guess: 0, but where handles say so.
  void begin(const System& system, const ImplicitStage& stage, VecX& u);
  // The displacement without forces, 0 where held: where a linear solver may start.
  void calc_drift(VecX& drift) const;

  Value calc_value(const VecX& u) override;
  double calc_gradient(const VecX& u, VecX& gradient) override;
  void calc_hessian(const VecX& u, bool exact, BlockMatrix& hessian) override;
  double calc_noise() const override { return noise_; }

  // All forces at the u of the last calc_gradient, held particles included.
  const VecX& force() const { return force_; }
  // W, of damping and friction at the velocity u / g; u as in the last calc_gradient.
  double calc_dissipated_power(const VecX& u) const;
  // Takes the normal forces at x* + u for friction. False: they hardly differ and stay.
  bool update_friction(const VecX& u);
  const std::vector<FrictionPoint>& friction_points() const { return friction_; }
  double slip() const { return slip_; }  // m
  const VecX& constant_force() const { return system_->constant_force(); }

 private:
  bool take_friction_at_x();
  void add_friction(const VecX& u, VecX& gradient, double& terms);

  const System* system_ = nullptr;
  const ImplicitStage* stage_ = nullptr;
  double noise_ = 0.0;                   // N
  double slip_ = 0.0;                    // m
  double constant_norm_ = 0.0;           // N, of the constant force
  std::vector<FrictionPoint> friction_;  // of the last round
  std::vector<FrictionPoint> found_;     // scratch
  BlockMatrix base_matrix_;  // M / g^2 + D / g, of this stage once a Hessian was asked for; only with damping
  bool base_is_valid_ = false;
  VecX x_, scratch_, velocity_, damping_, sliding_, force_;
  std::vector<Squares> squares_;  // of blocks
  double damping_power_ = 0.0;    // W
};

// Carries out implicit steps of one stage: Newton's method on the potential, again while friction's normal forces
// change.
class ImplicitSolver {
 public:
  ImplicitSolver(const System& system, const SolverSettings& settings)
      : newton_(settings, system.rest_positions()), hessian_(system.make_matrix()) {}

  void limit_iterations(int most) { newton_.limit_iterations(most); }
  // To be set before solve().
  ImplicitStage& stage() { return stage_; }
  // Finds the displacement from the stage's base.
  void solve(const System& system, StepStatistics& statistics);
  // The step of h seconds that follows from it.
  void finish(const System& system, double h, const DisplacementRule& rule, State& state, StepStatistics& statistics) {
    passes_.follow(system, h, rule, stage_.base, u_, potential_.force(), state, statistics);
  }
  // W, of damping and friction along the displacement.
  double calc_dissipated_power() const { return potential_.calc_dissipated_power(u_); }

 private:
  ImplicitStage stage_;
  IncrementalPotential potential_;
  NewtonSolver newton_;
  BlockMatrix hessian_;
  ParticlePasses passes_;
  VecX u_, guess_;
};

}  // namespace flexcast
