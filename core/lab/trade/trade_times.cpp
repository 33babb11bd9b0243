#include "core/lab/trade/trade_times.h"

#include <cmath>
#include <cstdio>

namespace flexcast {

Result<TradeTimes> make_trade_times(double frame, double until, std::int64_t common, int most) {
  const double spacing = frame * static_cast<double>(common), count = std::round(until / spacing);
  char text[200];
  constexpr double most_frames = 1e15;  // so that their numbers are exact in a double
  if (!(count * static_cast<double>(common) <= most_frames)) {
    std::snprintf(text, sizeof text, "%g s is too long (allowed: at most 1e15 steps of time.step = %g s)", until,
                  frame);
    return Error{text};
  }
  if (count < 1.0) {
    std::snprintf(text, sizeof text,
                  "%g s is too short: the settings have only the multiples of %g s in common (allowed: longer --until, "
                  "shorter --dt)",
                  until, spacing);
    return Error{text};
  }
  TradeTimes times{frame, {}};
  const auto last = static_cast<std::int64_t>(count);
  const std::int64_t stride = (last + most - 1) / most;
  for (std::int64_t i = stride; i < last; i += stride) times.compared.push_back(i * common);
  times.compared.push_back(last * common);
  return times;
}

}  // namespace flexcast
