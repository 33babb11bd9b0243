#include "core/lab/progress.h"

#include <cstdio>
#include <ostream>

namespace flexcast {
namespace {
constexpr std::chrono::milliseconds pause(250);
}  // namespace

Progress::Progress(std::ostream& log, bool active) : log_(log), active_(active), start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
  if (shown_) log_ << "\r\x1b[K" << std::flush;
}

void Progress::show(std::int64_t step, std::int64_t count, double time, double wall_seconds) {
  if (!active_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_ < pause) return;
  last_ = now;
  shown_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double remaining = elapsed * static_cast<double>(count - step) / static_cast<double>(step);
  char line[160];
  std::snprintf(line, sizeof line, "\rstep %lld of %lld, %.4g s simulated, %.3g x real time, %.0f s remaining\x1b[K",
                static_cast<long long>(step), static_cast<long long>(count), time,
                wall_seconds > 0.0 ? time / wall_seconds : 0.0, remaining);
  log_ << line << std::flush;
}

}  // namespace flexcast
