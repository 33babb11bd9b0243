// How far a run is, on one line of a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>

namespace flexcast {

class Progress {
 public:
  Progress(std::ostream& log, bool active);
  ~Progress();  // wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // A few times a second. `time` in simulated seconds, `wall_seconds` spent on them.
  void show(std::int64_t step, std::int64_t count, double time, double wall_seconds);

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& log_;
  bool active_;
  bool shown_ = false;
  Clock::time_point start_, last_;
};

}  // namespace flexcast
