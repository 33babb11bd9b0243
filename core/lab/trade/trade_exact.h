// Motions that are known without integrating: the key `exact` of a scene names one.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "core/base/result.h"
#include "core/sim/simulation.h"

namespace flexcast {

class ExactSolution {
 public:
  virtual ~ExactSolution() = default;
  // m, 3 n, `time` s after the start.
  virtual VecX calc_positions(double time) const = 0;
};

struct ExactRow {
  std::string_view name;  // as in scene files
  std::string_view summary;
  // From the simulation at its start, to which the solution keeps no reference. Errors: a scene that does not move so.
  Result<std::unique_ptr<ExactSolution>> (*make)(const Simulation& simulation);
};

// One per name of exact_names() (core/scene/keys.h).
std::span<const ExactRow> exact_solutions();
const ExactRow* find_exact(std::string_view name);

}  // namespace flexcast
