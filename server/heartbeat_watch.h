// HeartbeatWatch: for how long the step loop has not come round. It knows no clock: callers say what time it is.
#pragma once

#include <cstdint>

#include "server/convert/clock.h"

namespace flexcast::server {

class HeartbeatWatch {
 public:
  // Longer than nearly every step and command: somebody should know.
  static constexpr Clock::duration long_silence = std::chrono::seconds(1);

  // The heartbeat as it is now. Returns whether it has been the same for a long time.
  bool is_silent(Clock::time_point now, std::uint64_t heartbeat) {
    if (heartbeat != heartbeat_ || !begun_) beaten_ = now;
    begun_ = true;
    heartbeat_ = heartbeat;
    return now - beaten_ >= long_silence;
  }

 private:
  bool begun_ = false;
  std::uint64_t heartbeat_ = 0;
  Clock::time_point beaten_;
};

}  // namespace flexcast::server
