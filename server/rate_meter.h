// RateMeter: real-time factor and cost of a step over about the last second.
#pragma once

#include <cstdint>
#include <deque>

#include "server/convert/clock.h"

namespace flexcast::server {

class RateMeter {
 public:
  // The world starts to run (again) from simulated `time`.
  void start(Clock::time_point now, double time);
  // The world stands still: the factor is 0; the cost of a step stays as it was.
  void stop();

  // A step took `busy` of wall time and reached simulated `time`.
  void add_step(Clock::time_point now, double time, Clock::duration busy);

  bool started() const { return !marks_.empty(); }
  double real_time_factor(Clock::time_point now) const;  // simulated over wall seconds
  double step_seconds() const { return step_seconds_; }  // mean wall time of a step

 private:
  struct Mark {
    Clock::time_point wall;
    double time = 0.0;
    double busy = 0.0;
    std::uint64_t steps = 0;
  };
  Mark now_;                // totals so far
  std::deque<Mark> marks_;  // totals some time ago, the oldest first; at most one is older than the window
  double step_seconds_ = 0.0;
};

}  // namespace flexcast::server
