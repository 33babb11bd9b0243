// One line on stderr about how the replay is doing, rewritten in place on a terminal; silent in a pipe.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "clients/replay/replay.h"

namespace flexcast::replay {

// Calls may come from several threads.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show_reading(std::uint64_t messages);  // a few times a second at most
  void show(const Replay::Latest& latest);

  // A whole line, pipe or not; on a terminal it takes the place of the progress line.
  void say(const std::string& line);

 private:
  void rewrite(const std::string& text);

  bool terminal_;
  std::mutex mutex_;
  std::string shown_;
  Clock::time_point next_{};  // of show_reading
};

}  // namespace flexcast::replay
