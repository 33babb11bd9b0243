// The verb `limits`: where each integrator blows up, measured and predicted, and what that depends on.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/lab/limits/limit_search.h"
#include "core/lab/limits/limit_variations.h"

namespace flexcast {

struct LimitsOptions {
  std::filesystem::path scene;
  std::filesystem::path folder;          // for limits.csv, limits.json, limits.svg; made if need be
  std::vector<std::string> integrators;  // none: all that know time
  std::vector<std::string> quantities;   // none: all of variation_names()
  int points = 7;                        // of each quantity
  double budget = 60.0;                  // s, of all measurements; the one under way is given up then
  std::vector<std::string> overrides;
  bool json = false;
  int threads = 1;
  bool progress = false;
  const std::atomic<bool>* stop = nullptr;
};

// Of an explicit scheme at a value of a quantity.
struct LimitPoint {
  double value = 0.0;
  Limit limit;

  // Measured over predicted; nothing where either is missing, zero or not resolved.
  std::optional<double> calc_ratio() const;
};

struct LimitCurve {
  std::string integrator;
  std::vector<LimitPoint> points;  // rising values
};

struct LimitPanel {
  Variation variation;
  std::vector<LimitCurve> curves;
};

// Of an implicit scheme at one step.
struct BoundedRun {
  std::string integrator;
  double step = 0.0;  // s
  double gain = 0.0;  // largest energy norm over the first, in 100 steps; infinite: no number any more

  bool bounded() const { return gain <= 10.0; }
};

struct Limits {
  std::string scene;
  std::vector<LimitPanel> panels;
  std::vector<BoundedRun> runs;
  std::vector<std::string> notes;  // what was left out, and why
};

// Errors: a scene that cannot be loaded or has nothing that can move.
Result<Limits> find_limits(const LimitsOptions& options, std::ostream& log);

// The program's verb; returns the exit code.
int limits_verb(const LimitsOptions& options, std::ostream& out, std::ostream& log);

}  // namespace flexcast
