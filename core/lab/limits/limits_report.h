// Limits as a table for people, as CSV and JSON for programs, and as a picture.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/lab/limits/limits.h"
#include "core/lab/plot/plot.h"

namespace flexcast {

// How the measured limit goes with a quantity: the power between neighbours at either end.
struct LimitPower {
  double first = 0.0, last = 0.0;
};
// Nothing for fewer than two values with a limit.
std::optional<LimitPower> calc_power(const Variation& variation, const LimitCurve& curve);

std::string make_limits_text(const Limits& limits);

// A row a measurement: quantity, value, integrator, measured (s), predicted (s), ratio, and 1 or 0: resolved. Empty: no
// limit.
std::string make_limits_csv(const Limits& limits);

// null: no limit.
nlohmann::ordered_json make_limits_json(const Limits& limits);

Plot make_limits_plot(const Limits& limits);

}  // namespace flexcast
