// Model: the constants of a scene as plain arrays. It is filled once by whoever builds the scene; afterwards only the
// parameter table writes to it, between two steps, and calls what has to follow (update_masses). Forces keep a
// reference to it and read their coefficients at each evaluation, so that a changed parameter needs no rebuilding.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/materials/law.h"
#include "core/mesh/mesh.h"

namespace flexcast {

struct ParticleMass {
  std::int32_t particle = 0;  // of the world
  double value = 0.0;         // kg, > 0
};

struct Body {
  std::string name;
  IndexRange particles;   // of the world
  IndexRange tetrahedra;  // of Model::tetrahedra; empty for springs
  IndexRange springs;     // of Model::springs; empty for fem
  IndexRange triangles;   // of Model::triangles

  // fem
  const Law* law = nullptr;
  double young = 0.0;              // Pa
  double poisson = 0.0;            // 1
  double density = 0.0;            // kg/m^3
  double stiffness_damping = 0.0;  // s, Kelvin-Voigt

  // mass_spring
  double stiffness = 0.0;      // k_s, N
  double damping = 0.0;        // k_d, N.s
  double particle_mass = 0.0;  // kg

  // either
  double mass_damping = 0.0;                 // alpha, 1/s
  double drag = 0.0;                         // N.s/m a particle
  std::vector<ParticleMass> mass_overrides;  // later ones win

  bool is_fem() const { return law != nullptr; }
};

struct Model {
  std::vector<Body> bodies;
  VecX rest_positions;  // m, 3 n
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Spring> springs;
  std::vector<Triangle> triangles;  // surfaces, for people to look at
  VecX masses;                      // kg, n; update_masses() fills it
  std::vector<std::uint8_t> fixed;  // 3 n, 1: the degree of freedom stays where it starts, at zero velocity
  Vec3 gravity = Vec3::Zero();      // m/s^2
  VecX external_forces;             // N, 3 n, dead loads; empty when the scene names none

  std::int64_t particle_count() const { return rest_positions.size() / 3; }
};

// Masses from density and rest volume (a quarter of each tetrahedron to each corner) or the mass per particle, then the
// overrides.
void update_masses(Model& model);

// Where a particle, tetrahedron or spring of the world belongs; nullptr when no body has it.
const Body* find_body_of_particle(const Model& model, std::int64_t particle);
const Body* find_body(const Model& model, std::string_view name);

}  // namespace flexcast
