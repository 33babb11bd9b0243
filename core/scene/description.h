// A scene as its file says it, before any mesh exists. Defaults stand beside the fields; places lead errors that show
// only later (a selector that selects nothing) back to file and line.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/forces/model.h"
#include "core/scene/place.h"
#include "core/sim/settings.h"

namespace flexcast {

// Particles of a body, chosen in rest coordinates (after scale, rotation and origin), bounds included.
struct BoxSelector {
  Vec3 lower, upper;  // m
};
struct SphereSelector {
  Vec3 center;        // m
  double radius = 0;  // m
};
struct NodeSelector {
  std::vector<std::int64_t> nodes;  // numbers within the body
};
struct AllSelector {};

struct Selector {
  std::variant<AllSelector, BoxSelector, SphereSelector, NodeSelector> what;
  Place place;
};

struct MeshDescription {
  std::string shape;                // a row of shape_rows(); empty: a file
  std::vector<std::int64_t> cells;  // one a dimension of the shape, >= 1
  std::vector<double> size;         // m, likewise, > 0
  std::string file;                 // as written
  double scale = 1.0;               // of a file's coordinates
  Place place;
};

// Degrees of freedom that stay where they start. Several pins of a particle unite their axes.
struct PinDescription {
  Selector select;
  std::array<bool, 3> axes = {true, true, true};
};

// A vector for the selected particles. Several entries of a particle add up.
struct VectorDescription {
  Selector select;
  Vec3 value = Vec3::Zero();  // displacement: m; force: N
};

// Initial velocity: value + spin x (x - about), x the starting position. Several entries of a particle add up.
struct VelocityDescription {
  Selector select;
  Vec3 value = Vec3::Zero();  // m/s
  Vec3 spin = Vec3::Zero();   // rad/s
  Vec3 about = Vec3::Zero();  // m
};

// Particles that move as one rigid body, as prescribed.
struct HandleDescription {
  std::string name;
  Place place;  // of its name
  Selector select;
  std::optional<Vec3> about;      // m; else the centroid of the selected rest particles
  Vec3 translate = Vec3::Zero();  // m
  Vec3 rotate = Vec3::Zero();     // rotation vector, rad
  double start = 0.0;             // s, >= 0
  double duration = 0.0;          // s, >= 0; 0: at once
};

// The mass of single particles; later entries win.
struct MassDescription {
  Selector select;
  double value = 0.0;  // kg, > 0
};

struct BodyDescription {
  std::string name;
  Place place;  // of the [[body]]
  MeshDescription mesh;

  // fem
  const Law* law = nullptr;  // null: mass_spring
  double young = 0.0;        // Pa
  double poisson = 0.0;
  double density = 0.0;                           // kg/m^3
  double damping_stiffness = 0.0;                 // s
  bool quadratic = false;                         // tet10
  std::vector<VectorDescription> surface_forces;  // N in all, dead, on the boundary faces of the selection

  // mass_spring
  double spring_stiffness = 0.0;     // N
  double spring_damping = 0.0;       // N.s
  std::optional<double> mass;        // kg per particle; either this
  std::optional<double> total_mass;  // kg, or this

  // either
  double damping_mass = 0.0;     // 1/s
  double drag = 0.0;             // N.s/m on each particle
  Vec3 origin = Vec3::Zero();    // m; rest = R (scale X) + origin
  Vec3 rotation = Vec3::Zero();  // rotation vector, rad
  std::vector<MassDescription> particle_masses;
  std::vector<PinDescription> pins;
  std::vector<VectorDescription> displacements;
  std::vector<VelocityDescription> velocities;
  std::vector<VectorDescription> forces;
  std::vector<HandleDescription> handles;
};

struct ProbeDescription {
  std::string name;
  std::string body;
  std::optional<Vec3> at;            // m, rest coordinates: the nearest particle, the lowest number on a tie
  std::optional<std::int64_t> node;  // or this one of the body
  Place place;
};

struct SceneDescription {
  std::string name;
  std::string description;
  std::string exact;            // one of exact_names(): its solution is known; "": it is not
  Vec3 gravity = Vec3::Zero();  // m/s^2
  Settings settings;
  std::vector<BodyDescription> bodies;
  std::vector<Obstacle> obstacles;
  std::vector<ProbeDescription> probes;
};

}  // namespace flexcast
