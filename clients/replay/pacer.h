// Pacer: when the next frame is due, so that simulated time keeps `rate` times the pace of wall time. It knows no
// clock: callers say what time it is.
#pragma once

#include <chrono>
#include <optional>

namespace flexcast::replay {

using Clock = std::chrono::steady_clock;

class Pacer {
 public:
  // A replay that lags by more than this drops the debt: no burst of frames to catch up.
  static constexpr Clock::duration most_debt = std::chrono::milliseconds(250);

  // Simulated seconds per wall second; 0: as fast as possible.
  explicit Pacer(double rate) : rate_(rate) {}

  double rate() const { return rate_; }
  void set_rate(double rate);  // starts the pace afresh

  // Starts the pace afresh at the next call of calc_wait: after a pause, or where time jumps.
  void restart() { anchor_.reset(); }

  // How long to wait with the frame of `next_time` while that of `time` is shown; zero when it is due. The first call
  // after a restart fixes the start: `time` belongs to `now`. Where time jumps back the frame is due at once.
  Clock::duration calc_wait(Clock::time_point now, double time, double next_time);

 private:
  struct Anchor {
    Clock::time_point wall;
    double time = 0.0;
  };
  double rate_;
  std::optional<Anchor> anchor_;
};

}  // namespace flexcast::replay
