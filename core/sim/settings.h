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
  int substeps = 1;  // integrator steps per step; without one of the contracts
  // The contracts; 0: none, and never both. What they choose is in TimeChoice.
  double tolerance = 0.0;               // RMS position error made per second of simulated time, over the scene's size
  double budget = 0.0;                  // wall time per step over `step`
  std::string error_estimate = "free";  // free | doubling: how the error of a step is estimated
  std::optional<double> duration;       // s; where a run without --until and --steps ends
};

// The engine does not publish; it carries these for those who do.
struct StreamSettings {
  std::vector<std::string> fields = {"positions"};  // "positions", "velocities", "stretch", "stress"
  std::string precision = "float32";                // float32 | float64 | quantized16
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
