// Waiting by the wall clock.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "clients/client/value.h"

namespace flexcast::client {

// A timeout that never passes.
inline constexpr std::chrono::nanoseconds forever = std::chrono::nanoseconds::max();

class Deadline {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Deadline(std::chrono::nanoseconds timeout) : start_(Clock::now()), timeout_(timeout) {}

  std::chrono::nanoseconds left() const {
    if (timeout_ == forever) return forever;
    return std::max<std::chrono::nanoseconds>(timeout_ - (Clock::now() - start_), std::chrono::nanoseconds(0));
  }
  bool passed() const { return left().count() == 0; }

 private:
  Clock::time_point start_;
  std::chrono::nanoseconds timeout_;
};

// "10 s", "0.25 s"
inline std::string seconds_text(std::chrono::nanoseconds duration) {
  if (duration == forever) return "any time";
  return to_text(std::round(std::chrono::duration<double, std::milli>(duration).count()) / 1000.0) + " s";
}

}  // namespace flexcast::client
