// RateLimit: so many a second, with a burst.
#pragma once

#include <algorithm>
#include <chrono>

namespace flexcast::web {

class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;
  RateLimit(double per_second, double burst) : per_second_(per_second), burst_(burst), left_(burst) {}

  // False: one too many.
  bool pass(Clock::time_point now) {
    if (last_ != Clock::time_point{})
      left_ = std::min(burst_, left_ + per_second_ * std::chrono::duration<double>(now - last_).count());
    last_ = now;
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
  }

 private:
  double per_second_, burst_, left_;
  Clock::time_point last_{};
};

}  // namespace flexcast::web
