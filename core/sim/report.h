// What is known about a step after it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/math.h"
#include "core/state/step_statistics.h"

namespace flexcast {

struct StepReport {
  std::int64_t step = 0;
  double time = 0.0;  // s
  // J. gravity = -sum m g.x; work: of dead forces, handles, grabs, and the jumps of live parameter changes; dissipated:
  // by damping and friction. kinetic + elastic + gravity + contact - work + dissipated - numerical is constant.
  double kinetic = 0.0, elastic = 0.0, gravity = 0.0, contact = 0.0, work = 0.0, dissipated = 0.0;
  double numerical = 0.0;                // J, the scheme's own gain (+) or loss (-); see energy_books.h
  Vec3 momentum = Vec3::Zero();          // kg.m/s
  Vec3 angular_momentum = Vec3::Zero();  // kg.m^2/s, about the world's origin
  StepStatistics statistics;
  std::optional<double> error_estimate;    // m, RMS over the particles: what the step did wrong; absent: not known
  std::optional<double> stability_margin;  // stable step / step; absent for schemes without a limit
  std::int64_t inverted = 0;               // tetrahedra with J <= 0
  std::optional<double> min_j;             // smallest det F; absent without tetrahedra
};

// Per body, for those who ask.
struct BodyReport {
  std::string name;
  std::int64_t particles = 0, elements = 0;  // elements: tetrahedra or springs
  std::optional<double> min_j;
  std::int64_t inverted = 0;
  Vec3 center_of_mass = Vec3::Zero();
};

// What a handle exerts on its body to move it as it does.
struct HandleReport {
  std::string name;
  Vec3 force = Vec3::Zero();   // N
  Vec3 torque = Vec3::Zero();  // N.m, about the moved `about`
};

// Why a step was refused. The state is the last good one.
struct Failure {
  std::string cause;
  std::string body;              // "" when no place can be named
  std::int64_t element = -1;     // tetrahedron or spring of the body, -1: none
  std::int64_t particle = -1;    // of the body, -1: none
  Vec3 position = Vec3::Zero();  // m, of the particle or the element's first particle before the step
  std::int64_t step = 0;         // the step that could not be taken
  std::string suggestion;        // what to change

  std::string text() const;  // all of it in one sentence
};

}  // namespace flexcast
