// One line about how the world is doing, rewritten in place on a terminal.
#pragma once

#include <string>

#include "server/publisher.h"

namespace flexcast::server {

// "running  step 1200  time 1.2 s  rate 0.998  frames 1201, 3 skipped  readers 2"
std::string progress_text(const Publisher::Latest& latest);

class ProgressLine {
 public:
  // Silent unless stderr is a terminal.
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const std::string& text);

 private:
  bool terminal_;
  std::string shown_;
};

}  // namespace flexcast::server
