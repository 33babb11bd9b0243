// How many steps a run takes that is given an end, or none.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/result.h"
#include "core/sim/settings.h"

namespace flexcast {

// round(T / time.step), T being `until` (s), else the scene's duration; 1,000 without both. Error: more than 1e15 steps,
// whose numbers would not be exact in a double.
Result<std::int64_t> calc_run_length(std::optional<double> until, const TimeSettings& time);

}  // namespace flexcast
