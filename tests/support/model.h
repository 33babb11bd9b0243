// Small models built by hand, for configurations that no scene shape has: single tetrahedra, free springs.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mesh/generators.h"
#include "core/mesh/quadratic.h"
#include "core/sim/simulation.h"

namespace flexcast::test {

using Points = std::vector<Vec3>;

inline VecX flatten(const Points& points) {
  VecX flat(3 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) block3(flat, static_cast<std::int64_t>(i)) = points[i];
  return flat;
}

inline Model make_model(const VecX& rest_positions) {
  Model model;
  model.rest_positions = rest_positions;
  model.masses = VecX::Zero(rest_positions.size() / 3);
  model.fixed.assign(static_cast<std::size_t>(rest_positions.size()), 0);
  Body body;
  body.name = "body";
  body.particles = {0, static_cast<std::int32_t>(rest_positions.size() / 3)};
  model.bodies.push_back(body);
  return model;
}

struct SpringConstants {
  double stiffness = 0.0;  // k_s, N
  double damping = 0.0;    // k_d, N.s
};

inline Model make_spring_model(const Points& rest, const std::vector<Spring>& springs, SpringConstants constants,
                               double particle_mass) {
  Model model = make_model(flatten(rest));
  model.springs = springs;
  Body& body = model.bodies[0];
  body.springs = {0, static_cast<std::int32_t>(springs.size())};
  body.stiffness = constants.stiffness;
  body.damping = constants.damping;
  body.particle_mass = particle_mass;
  return model;
}

struct Elastic {
  std::string_view law = "corotational";
  double young = 1.3e5;     // Pa
  double poisson = 0.3;     // 1
  double density = 1000.0;  // kg/m^3
};

inline Model make_tet_model(const Points& rest, const std::vector<Tetrahedron>& tetrahedra, const Elastic& elastic) {
  Model model = make_model(flatten(rest));
  model.tetrahedra = tetrahedra;
  Body& body = model.bodies[0];
  body.tetrahedra = {0, static_cast<std::int32_t>(tetrahedra.size())};
  body.law = find_law(elastic.law);
  if (body.law == nullptr) throw std::runtime_error("no law named " + std::string(elastic.law));
  body.young = elastic.young;
  body.poisson = elastic.poisson;
  body.density = elastic.density;
  return model;
}

inline Model make_beam_model(const Mesh& mesh, const Elastic& elastic) {
  return make_tet_model(mesh.nodes, mesh.tetrahedra, elastic);
}

// Ten-node tetrahedra, made from the mesh's.
inline Model make_quadratic_model(Mesh mesh, const Elastic& elastic) {
  const std::vector<Midsides> midsides = make_quadratic(mesh);
  Model model = make_beam_model(mesh, elastic);
  model.midsides = midsides;
  model.bodies[0].midsides = {0, static_cast<std::int32_t>(midsides.size())};
  return model;
}

inline Points corner_tet() {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

inline Settings make_settings(std::string integrator, double step) {
  Settings settings;
  settings.time.integrator = std::move(integrator);
  settings.time.step = step;
  settings.solver.linear = "ldlt";
  settings.solver.linear_tolerance = 1e-14;
  settings.solver.newton_tolerance = 1e-14;
  settings.solver.newton_iterations = 50;
  return settings;
}

inline State make_state(const VecX& positions, const VecX& velocities) {
  State state;
  state.positions = positions;
  state.velocities = velocities;
  return state;
}
inline State make_state(const VecX& positions) {
  return make_state(positions, VecX::Zero(positions.size()));
}

// The force on every particle, N: one symplectic Euler step of 1 s changes the velocity by f / m.
inline VecX measure_forces(const Model& model, const VecX& positions, const VecX& velocities) {
  Simulation simulation(model, make_settings("symplectic_euler", 1.0), make_state(positions, velocities), {});
  if (!simulation.step()) throw std::runtime_error(simulation.failure()->text());
  VecX forces = simulation.state().velocities - velocities;
  for (std::int64_t i = 0; i < model.particle_count(); ++i) block3(forces, i) *= simulation.model().masses[i];
  return forces;
}
inline VecX measure_forces(const Model& model, const VecX& positions) {
  return measure_forces(model, positions, VecX::Zero(positions.size()));
}

// J, of the springs and tetrahedra.
inline double measure_elastic_energy(const Model& model, const VecX& positions) {
  return Simulation(model, make_settings("symplectic_euler", 1.0), make_state(positions), {}).calc_report().elastic;
}

}  // namespace flexcast::test
