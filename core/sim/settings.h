// How a scene is stepped and what of it is published: the scene's [time], [solver] and [stream] tables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/solvers/settings.h"

namespace flexcast {

struct TimeSettings {
  double step = 1e-3;  // s, > 0
  std::string integrator = "symplectic_euler";
  int substeps = 1;                // integrator steps per step
  std::optional<double> duration;  // s; where a run without --until and --steps ends
};

// The engine does not publish; it carries these for those who do.
struct StreamSettings {
  std::vector<std::string> fields = {"positions"};  // "positions", "velocities"
  std::string precision = "float32";                // float32 | float64
  int every = 1;                                    // publish every n-th step
};

struct Settings {
  TimeSettings time;
  SolverSettings solver;
  StreamSettings stream;
};

// A named particle that is watched.
struct Probe {
  std::string name;
  std::string body;
  std::int32_t particle = 0;  // of the world
};

}  // namespace flexcast
