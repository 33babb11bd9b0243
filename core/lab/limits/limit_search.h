// The largest step of a scheme at which a tiny perturbation of the rest state does not grow: measured with the scheme
// itself, not computed from modes.
#pragma once

#include <functional>
#include <optional>

#include "core/integrators/integrator.h"
#include "core/sim/settings.h"
#include "core/sim/simulation.h"

namespace flexcast {

// The scene's model with nothing in it but inertia, elasticity and damping: no gravity, loads, obstacles, grabs or
// friction, handles that hold their particles where they are, its middle in the origin.
Model make_quiet_model(const Model& model);

// How long is waited for growth. Near a limit most schemes gain at least 2 % a step for each per cent that the step is
// too long; forward Euler gains its damping times that, so it needs more steps and is watched more closely.
struct GrowthWatch {
  int steps = 0;
  double factor = 0.0;    // of the energy norm over its least value: instability. Rounding stays far below it.
  bool steadily = false;  // growth over all eighths of the second half is instability too
  // Asked now and then: whether there is no time any more. What is measured then says nothing.
  std::function<bool()> gives_up = {};
};
GrowthWatch choose_watch(const IntegratorRow& scheme);

// A perturbation of 1e-9 of the shortest edge, always the same scattered one, at the rest state of a quiet model.
class Perturbation {
 public:
  // Keeps a reference to the model, whose masses must be up to date.
  explicit Perturbation(const Model& model);

  // Whether it grows under the scheme at this step.
  bool grows(const IntegratorRow& scheme, double h, const GrowthWatch& watch) const;
  // Largest energy norm over the first one, in the steps of the watch, of a perturbation a million times as large;
  // infinite when it becomes no number.
  double calc_gain(const IntegratorRow& scheme, const SolverSettings& solver, double h, const GrowthWatch& watch) const;

 private:
  State make_start(double scale) const;
  double calc_norm(const State& state) const;

  const Model& model_;
  System system_;
  VecX direction_;     // 0 where held, within [-1, 1]
  double edge_ = 0.0;  // m, shortest
};

struct Limit {
  std::optional<double> measured;  // s, the longest step seen to be stable, to 1 %; nothing: no step was too long
  // Growth shows soon above that step; else it is so slow that the true limit may lie well below.
  bool resolved = true;
  std::optional<double> predicted;  // s, what the engine advertises; nothing: no limit. 0, of both: no step is stable
};

// For an explicit scheme and a quiet model.
Limit find_limit(const Model& model, const IntegratorRow& scheme, const std::function<bool()>& gives_up = {});

// Simulation::calc_stable_step of the quiet model at rest.
double calc_predicted_step(const Model& model, std::string_view integrator);

}  // namespace flexcast
