// One line on stderr about how the recording is doing, rewritten in place on a terminal; silent in a pipe.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "clients/record/reception.h"

namespace flexcast::record {

class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Rates are those since the last time it was rewritten, a few times a second. `bytes`: of the file.
  void show(const Progress& progress, std::uint64_t bytes);

  // A whole line, pipe or not; on a terminal it takes the place of the progress line.
  void say(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  struct Moment {
    Clock::time_point time;
    std::uint64_t frames = 0;
    std::uint64_t bytes = 0;
  };

  bool terminal_;
  bool shown_ = false;
  Moment last_;
};

}  // namespace flexcast::record
