// The verb `run`: a scene without network, as fast as it goes.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/scene.h"

namespace flexcast {

struct RunOptions {
  std::filesystem::path scene;
  std::optional<double> until;        // s; round(until / step) steps
  std::optional<std::int64_t> steps;  // 0: the initial state. Without both: the scene's duration, or 1000 steps
  std::vector<std::string> overrides;
  std::optional<std::filesystem::path> csv;        // a row per frame
  std::optional<std::filesystem::path> positions;  // the final ones
  bool at_equilibrium = false;                     // solve for equilibrium instead of stepping
  int threads = 1;                                 // of the engine; any number gives the same bits
  bool json = false;
  bool progress = false;                    // on the log while running
  const std::atomic<bool>* stop = nullptr;  // ends the run early when it becomes true
};

// A run that has ended.
struct Run {
  Scene scene;
  std::string state;  // finished | failed | stopped
  std::int64_t steps = 0;
  std::int64_t substeps = 0;      // integrator steps of all of them
  double wall_seconds = 0.0;      // in Simulation::step
  double static_tolerance = 0.0;  // what an equilibrium's residual must not pass
  std::vector<std::string> warnings;
};

// Loads and steps the scene; writes the files that were asked for. A simulation that fails is a run with that state.
Result<Run> run_scene(const RunOptions& options, std::ostream& log);

// The program's verb: results to `out`, everything else to `log`. Returns the exit code: 0, or 1 for a scene that
// cannot be loaded, a file that cannot be written, a simulation that failed or was stopped.
int run_verb(const RunOptions& options, std::ostream& out, std::ostream& log);

}  // namespace flexcast
