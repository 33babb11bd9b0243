// The server's clock: steady, for pacing and deadlines. Run ids alone come from the system clock (run_ids.h).
#pragma once

#include <chrono>

namespace flexcast::server {

using Clock = std::chrono::steady_clock;

inline double seconds(Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

// Clamped to a year, so that no duration overflows.
inline Clock::duration from_seconds(double value) {
  constexpr double year = 365.0 * 86400.0;
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value < year ? value : year));
}

}  // namespace flexcast::server
