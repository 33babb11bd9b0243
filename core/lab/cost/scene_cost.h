// The verb `scene-cost`: what each feature of a scene costs per step, by leaving it out, and what is done beside steps.
//
// The scene and its variants, each without one feature, are stepped in turns from their own starts: a variant that
// moves differently may need other solver iterations, which belongs to the cost and is told. The scene is stepped twice
// over; what its twin seems to cost is noise, and nothing below it is called a cost.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace flexcast {

struct SceneCostOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  int steps = 500;       // of each variant, at most
  double budget = 20.0;  // s, for the steps; at least five rounds are taken
  int threads = 1;       // of the engine
  bool json = false;
  bool progress = false;                    // on the log while running
  const std::atomic<bool>* stop = nullptr;  // ends the measurement when it becomes true
};

// By leaving it out.
struct FeatureCost {
  std::string name;
  std::optional<double> seconds;  // median step of the scene minus that of the variant; none: the variant failed
  double spread = 0.0;            // s; a difference below it is noise
  double iterations = 0.0, linear_iterations = 0.0;  // mean of a step without it
  std::string failure = {};                          // of the scene without it

  bool is_measurable() const { return seconds && (*seconds > spread || *seconds < -spread); }
};

// What no step does: it costs when it is asked for, or with every frame.
struct ExtraCost {
  std::string name;
  std::string when;      // "report", "frame"
  double seconds = 0.0;  // median
};

struct SceneCost {
  std::string scene, integrator;
  int threads = 1;
  std::int64_t elements = 0, particles = 0;
  int steps = 0;              // timed, of each variant
  double step_seconds = 0.0;  // median
  double noise = 0.0;         // s, what the scene's twin seemed to cost
  double iterations = 0.0, linear_iterations = 0.0;
  std::vector<FeatureCost> features;
  std::vector<ExtraCost> extras;
};

// Errors: a scene that cannot be loaded, that fails, or a measurement that was stopped.
Result<SceneCost> measure_scene_cost(const SceneCostOptions& options, std::ostream& log);

// The program's verb; returns the exit code.
int scene_cost_verb(const SceneCostOptions& options, std::ostream& out, std::ostream& log);

}  // namespace flexcast
