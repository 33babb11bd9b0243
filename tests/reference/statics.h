// Bars and their equilibria. Bars lie along x from the origin, of Kuhn tetrahedra or of ten-node ones made from them.
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "core/lab/statics.h"
#include "core/mesh/surface_load.h"
#include "tests/support/model.h"
#include "tests/support/scene.h"

namespace flexcast::test {

struct Bar {
  std::array<int, 3> cells = {10, 2, 2};
  std::array<double, 3> size = {1.0, 0.2, 0.2};  // m
  Elastic elastic{};
  bool quadratic = false;
  Vec3 end_force = Vec3::Zero();  // N, a uniform dead traction on the end face
};

inline Model make_solid_model(const Mesh& mesh, const Elastic& elastic, bool quadratic) {
  return quadratic ? make_quadratic_model(mesh, elastic) : make_beam_model(mesh, elastic);
}

inline Points rest_points(const Model& model) {
  Points points;
  for (std::int64_t i = 0; i < model.particle_count(); ++i) points.emplace_back(block3(model.rest_positions, i));
  return points;
}

// The numbers of the particles for which where(X) is true.
template <class Where>
std::vector<std::int64_t> find_particles(const Model& model, Where where) {
  std::vector<std::int64_t> found;
  for (std::int64_t i = 0; i < model.particle_count(); ++i) {
    if (where(Vec3(block3(model.rest_positions, i)))) found.push_back(i);
  }
  return found;
}

inline std::int64_t find_particle(const Model& model, const Vec3& at) {
  const auto found = find_particles(model, [&](const Vec3& X) { return (X - at).norm() < 1e-9 * (1.0 + at.norm()); });
  return found.size() == 1 ? found[0] : throw std::runtime_error("not one particle there");
}

// Holds all three axes, or one, of the particles for which where(X) is true.
template <class Where>
void hold(Model& model, Where where, int axis = -1) {
  for (const std::int64_t i : find_particles(model, where)) {
    for (int a = 0; a < 3; ++a) {
      if (axis < 0 || axis == a) model.fixed[static_cast<std::size_t>(3 * i + a)] = 1;
    }
  }
}

// The force, N in all, as a uniform traction over the boundary faces whose corners are chosen by where(X).
template <class Where>
void load(Model& model, Where where, const Vec3& force) {
  std::vector<std::uint8_t> selected(static_cast<std::size_t>(model.particle_count()), 0);
  for (const std::int64_t i : find_particles(model, where)) selected[static_cast<std::size_t>(i)] = 1;
  Points forces(selected.size(), Vec3::Zero());
  spread_surface_force(selected, rest_points(model), model.tetrahedra, model.midsides, force, forces);
  model.external_forces = flatten(forces);
}

// Clamped at x = 0, pulled at the other end.
inline Model make_clamped_bar(const Bar& bar) {
  Model model = make_solid_model(make_beam(bar.cells, bar.size), bar.elastic, bar.quadratic);
  hold(model, [](const Vec3& X) { return X.x() == 0.0; });
  const double length = bar.size[0];
  load(
      model, [&](const Vec3& X) { return std::abs(X.x() - length) < 1e-9 * length; }, bar.end_force);
  return model;
}

inline std::unique_ptr<Simulation> make_simulation(const Model& model, const Settings& settings, const State& state) {
  return std::make_unique<Simulation>(model, settings, state, std::vector<Probe>{});
}

// In equilibrium: forces balance to the tolerance times those that a strain of 1e-6 causes, or the loads where they are
// larger.
inline std::unique_ptr<Simulation> solve_equilibrium(const Model& model, double tolerance = 1e-10) {
  Settings settings = make_settings("quasi_static", 1.0);
  settings.solver.newton_tolerance = tolerance;
  auto simulation = make_simulation(model, settings, make_state(model.rest_positions));
  for (int i = 0; i < 20; ++i) {
    run(*simulation, 1);
    if (simulation->statistics().converged) return simulation;
  }
  ADD_FAILURE() << "no equilibrium, residual " << simulation->statistics().residual;
  return simulation;
}

inline Vec3 displacement(const Simulation& simulation, std::int64_t particle) {
  return position(simulation, particle) - block3(simulation.model().rest_positions, particle);
}

// The mean of a displacement over the loaded face, weighted with the load: its work over its size.
inline double calc_work_mean(const Simulation& simulation) {
  const Model& model = simulation.model();
  Vec3 total = Vec3::Zero();
  for (std::int64_t i = 0; i < model.particle_count(); ++i) total += block3(model.external_forces, i);
  return model.external_forces.dot(simulation.state().positions - model.rest_positions) / total.norm();
}

}  // namespace flexcast::test
