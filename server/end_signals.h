// EndSignals: how a program is asked to end. The first SIGINT or SIGTERM asks it to; what has not come to its end a
// grace later, or at a second signal, is to be cut off.
#pragma once

#include <csignal>
#include <optional>
#include <string>

#include "server/convert/clock.h"

namespace flexcast::server {

class EndSignals {
 public:
  static constexpr Clock::duration grace = std::chrono::seconds(5);

  // Blocks both signals for this thread and those it starts from now on: to be made before any other thread.
  EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  // Waits for a signal, `longest` at most.
  void wait(Clock::duration longest);

  bool asked() const { return asked_at_.has_value(); }
  // Whether what was asked to end is to be cut off now.
  bool impatient() const { return again_ || (asked_at_ && Clock::now() - *asked_at_ >= grace); }
  // "5 s after SIGTERM" or "at a second SIGINT". To be called when impatient.
  std::string reason() const;

  // From now on a signal ends the process as if nobody had ever blocked it.
  void let_kill() const;

 private:
  sigset_t signals_;
  std::optional<Clock::time_point> asked_at_;
  int first_ = 0, last_ = 0;  // signals
  bool again_ = false;
};

}  // namespace flexcast::server
