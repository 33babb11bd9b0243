// Pacer: when the next step is due, so that simulated time keeps `rate` times the pace of wall time. It knows no clock:
// callers say what time it is.
#pragma once

#include <optional>

#include "server/convert/clock.h"

namespace flexcast::server {

class Pacer {
 public:
  // Debt beyond this is dropped: the pace starts afresh from now, without a burst of steps to catch up.
  static constexpr Clock::duration most_debt = std::chrono::milliseconds(250);

  // Simulated seconds per wall second; 0: as fast as possible.
  explicit Pacer(double rate) : rate_(rate) {}

  // A changed rate starts the pace afresh.
  void set_rate(double rate);

  // Starts the pace afresh at the next call of calc_wait: after a pause, a reset.
  void restart() { anchor_.reset(); }

  // How long to wait until the step from simulated `time` to `next_time` is due; zero when it is. The first call after
  // a restart fixes the start: state `time` belongs to `now`.
  Clock::duration calc_wait(Clock::time_point now, double time, double next_time);

 private:
  struct Anchor {
    Clock::time_point wall;
    double time = 0.0;
  };
  double rate_;
  std::optional<Anchor> anchor_;
};

}  // namespace flexcast::server
