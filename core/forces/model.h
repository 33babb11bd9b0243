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
  IndexRange midsides;    // of Model::midsides: as many as tetrahedra when these are quadratic, else empty
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
  bool is_quadratic() const { return midsides.count > 0; }
};

// Particles that move as one rigid body, as prescribed: x = about + R(a rotate) (base - about) + a translate, where the
// progress a grows linearly from 0 at `start` to 1 at `start + duration`.
struct Handle {
  std::string name;
  std::int32_t body = 0;
  std::vector<std::int32_t> particles;  // of the world
  std::vector<Vec3> base;               // m, where they start
  Vec3 about = Vec3::Zero();            // m
  Vec3 translate = Vec3::Zero();        // m
  Vec3 rotate = Vec3::Zero();           // rotation vector, rad
  double start = 0.0;                   // s
  double duration = 0.0;                // s; 0: at once
};

// Something solid that particles cannot enter.
struct Obstacle {
  enum class Shape { plane, sphere, box };
  std::string name;
  Shape shape = Shape::plane;
  Vec3 point = Vec3::Zero();                  // m, plane: a point on it
  Vec3 normal = Vec3::UnitZ();                // plane: into the free side, any length but 0
  Vec3 center = Vec3::Zero();                 // m, sphere
  double radius = 0.0;                        // m, sphere
  Vec3 lo = Vec3::Zero(), hi = Vec3::Zero();  // m, box, lo < hi
  double friction = 0.0;                      // Coulomb's coefficient
  double stiffness = 0.0;                     // N/m a particle; 0: chosen by the engine
};

// A particle pulled to a place by a spring of rest length 0.
struct Grab {
  std::int32_t particle = 0;   // of the world
  Vec3 target = Vec3::Zero();  // m
  double stiffness = 0.0;      // N/m, > 0
};

struct Model {
  std::vector<Body> bodies;
  VecX rest_positions;                  // m, 3 n
  std::vector<Tetrahedron> tetrahedra;  // their corners
  std::vector<Midsides> midsides;       // of quadratic ones
  std::vector<Spring> springs;
  std::vector<Triangle> triangles;  // surfaces, for people to look at
  VecX masses;                      // kg, n; update_masses() fills it
  std::vector<std::uint8_t> fixed;  // 3 n, 1: the degree of freedom stays where it starts, at zero velocity
  Vec3 gravity = Vec3::Zero();      // m/s^2
  VecX external_forces;             // N, 3 n, dead loads; empty when the scene names none
  std::vector<Handle> handles;      // no two share a particle, none has a fixed one
  std::vector<Obstacle> obstacles;
  std::vector<Grab> grabs;  // at most one a particle
  // s: handles without duration are where they are at this time; it follows the state between two steps, so that they
  // jump there.
  double jump_time = 0.0;

  std::int64_t particle_count() const { return rest_positions.size() / 3; }
};

// Masses from density and rest volume or the mass per particle, then the overrides. A linear tetrahedron gives a
// quarter of its mass to each corner, a quadratic one 1/36 to each corner and 4/27 to each midside node: the diagonal
// of its consistent mass matrix, scaled to its mass. Source: E. Hinton, T. Rock, O. C. Zienkiewicz, Earthquake Eng.
// Struct. Dyn. 4 (1976) 245-249.
void update_masses(Model& model);

// Where a particle, tetrahedron or spring of the world belongs; nullptr when no body has it.
const Body* find_body_of_particle(const Model& model, std::int64_t particle);
const Body* find_body(const Model& model, std::string_view name);

}  // namespace flexcast
