#include "core/lab/run_length.h"

#include <cmath>
#include <cstdio>

namespace flexcast {

Result<std::int64_t> calc_run_length(std::optional<double> until, const TimeSettings& time) {
  constexpr std::int64_t default_steps = 1000;
  constexpr double most_steps = 1e15;
  const std::optional<double> end = until ? until : time.duration;
  if (!end) return default_steps;
  const double steps = std::round(*end / time.step);
  if (steps > most_steps) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "--until or time.duration: %g s is too long (allowed: at most 1e15 steps of time.step = %g s)", *end,
                  time.step);
    return Error{text};
  }
  return static_cast<std::int64_t>(steps);
}

}  // namespace flexcast
