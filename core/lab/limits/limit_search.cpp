#include "core/lab/limits/limit_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/lab/bench/bench_state.h"

namespace flexcast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double amplitude = 1e-9;     // of the shortest edge
constexpr double resolution = 1.0101;  // between a stable and an unstable step
constexpr double most_above = 1e3;     // times the first step: further up there is no limit
constexpr double least_gain = 1.02;    // over the second half, where growth is steady

State make_rest(const Model& model) {
  return {model.rest_positions, VecX::Zero(model.rest_positions.size())};
}

// m; 0 without elements.
double find_shortest_edge(const Model& model) {
  double shortest = infinity;
  const auto look = [&](std::int32_t p, std::int32_t q) {
    shortest = std::min(shortest, (block3(model.rest_positions, p) - block3(model.rest_positions, q)).norm());
  };
  for (const Spring& spring : model.springs) look(spring[0], spring[1]);
  for (const Tetrahedron& tetrahedron : model.tetrahedra)
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < i; ++k)
        look(tetrahedron[static_cast<std::size_t>(i)], tetrahedron[static_cast<std::size_t>(k)]);
  return std::isfinite(shortest) ? shortest : 0.0;
}

}  // namespace

Model make_quiet_model(const Model& model) {
  Model quiet = model;
  quiet.gravity.setZero();
  quiet.external_forces.resize(0);
  quiet.obstacles.clear();
  quiet.grabs.clear();
  const Eigen::Map<const Eigen::Matrix3Xd> rest(model.rest_positions.data(), 3, model.particle_count());
  const Vec3 middle = rest.rowwise().mean();
  for (std::int64_t i = 0; i < model.particle_count(); ++i) block3(quiet.rest_positions, i) -= middle;
  for (const Handle& handle : model.handles)
    for (const std::int32_t particle : handle.particles)
      for (int axis = 0; axis < 3; ++axis) quiet.fixed[static_cast<std::size_t>(3 * particle + axis)] = 1;
  quiet.handles.clear();
  return quiet;
}

// Symplectic Euler and velocity Verlet without damping gain a factor of 1.3 a step at 1 % too much, with much of it
// 1.02: 900 steps make 1e6 of the share, a thirtieth or so, that the fastest mode has of the start.
GrowthWatch choose_watch(const IntegratorRow& scheme) {
  if (scheme.name == "forward_euler") return {6000, 1e3, true, {}};
  return {1500, 1e6, false, {}};
}

Perturbation::Perturbation(const Model& model) : model_(model), system_(model), edge_(find_shortest_edge(model)) {
  direction_ = make_scattered(model.rest_positions.size()).cwiseProduct(system_.free());
}

// At rest but for the positions: motions without stiffness get no velocity and do not drift away.
State Perturbation::make_start(double scale) const {
  State state = make_rest(model_);
  state.positions += scale * edge_ * direction_;
  return state;
}

// The root of the energy, of which the elastic part is the work of the present forces: exact for small perturbations.
double Perturbation::calc_norm(const State& state) const {
  VecX force;
  system_.calc_conservative(state.positions, force);
  const VecX moved = (state.positions - model_.rest_positions).cwiseProduct(system_.free());
  return std::sqrt(system_.calc_kinetic(state.velocities) + 0.5 * std::abs(moved.dot(force)));
}

bool Perturbation::grows(const IntegratorRow& scheme, double h, const GrowthWatch& watch) const {
  constexpr int pause = 10;   // steps between two looks
  constexpr int windows = 8;  // of the second half
  const auto integrator = scheme.make(system_, SolverSettings{});
  State state = make_start(amplitude);
  StepStatistics statistics;
  const double first = calc_norm(state);
  double least = first;
  std::array<double, windows> largest{};
  for (int step = 1; step <= watch.steps; ++step) {
    integrator->step(system_, h, state, statistics);
    if (step % pause != 0) continue;
    if (watch.gives_up && watch.gives_up()) return true;
    const double norm = calc_norm(state);
    // What has died away to rounding may do what it likes below a tenth of the start.
    if (!(norm <= std::max(watch.factor * least, 0.1 * first))) return true;
    least = std::min(least, norm);
    const int window = (2 * step - watch.steps - 1) * windows / watch.steps;
    if (2 * step > watch.steps) {
      double& most = largest[static_cast<std::size_t>(std::clamp(window, 0, windows - 1))];
      most = std::max(most, norm);
    }
  }
  return watch.steadily && largest[windows - 1] > std::max(least_gain * largest[0], 1e-3 * first) &&
         std::is_sorted(largest.begin(), largest.end());
}

double Perturbation::calc_gain(const IntegratorRow& scheme, const SolverSettings& solver, double h,
                               const GrowthWatch& watch) const {
  const auto integrator = scheme.make(system_, solver);
  State state = make_start(1e6 * amplitude);
  StepStatistics statistics;
  const double first = calc_norm(state);
  double largest = first;
  for (int step = 0; step < watch.steps && !(watch.gives_up && watch.gives_up()); ++step) {
    integrator->step(system_, h, state, statistics);
    state.time += h;
    const double norm = calc_norm(state);
    if (!std::isfinite(norm)) return infinity;
    largest = std::max(largest, norm);
  }
  return first > 0.0 ? largest / first : 1.0;
}

double calc_predicted_step(const Model& model, std::string_view integrator) {
  Settings settings;
  settings.time.integrator = integrator;
  return Simulation(model, settings, make_rest(model), {}).calc_stable_step();
}

Limit find_limit(const Model& model, const IntegratorRow& scheme, const std::function<bool()>& gives_up) {
  const double predicted = calc_predicted_step(model, scheme.name);
  Limit limit;
  if (std::isfinite(predicted)) limit.predicted = predicted;
  GrowthWatch watch = choose_watch(scheme);
  watch.gives_up = gives_up;
  const Perturbation perturbation(model);
  // Where no step is said to be stable, one far below what another scheme bears is looked at.
  const double start =
      std::isfinite(predicted) && predicted > 0.0 ? predicted : 0.05 * calc_predicted_step(model, "symplectic_euler");
  if (!std::isfinite(start) || !(start > 0.0)) return limit;
  double stable = 0.0, unstable = infinity;
  if (perturbation.grows(scheme, start, watch)) {
    unstable = start;
    for (double factor = 0.98; factor > 0.01 && stable == 0.0; factor *= factor) {
      (perturbation.grows(scheme, factor * start, watch) ? unstable : stable) = factor * start;
    }
    limit.measured = 0.0;
    if (stable == 0.0) return limit;
  } else {
    stable = start;
    for (double above = 0.01; above < most_above && unstable == infinity; above *= 2.0) {
      (perturbation.grows(scheme, (1.0 + above) * start, watch) ? unstable : stable) = (1.0 + above) * start;
    }
    if (unstable == infinity) return limit;
  }
  while (unstable > resolution * stable) {
    const double middle = std::sqrt(stable * unstable);
    (perturbation.grows(scheme, middle, watch) ? unstable : stable) = middle;
  }
  limit.measured = stable;
  // A limit that hangs on how long one waits is none.
  constexpr double above = 1.02;
  watch.steps /= 2;
  limit.resolved = perturbation.grows(scheme, above * stable, watch);
  return limit;
}

}  // namespace flexcast
