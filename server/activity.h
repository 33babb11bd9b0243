// Activity: what the step loop is at, written by its thread, to be read by others when it does not come back.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "server/convert/command_types.h"

namespace flexcast::server {

class Activity {
 public:
  void begin_step(std::int64_t step) { now_ = step; }
  void begin_command(CommandKind kind) { now_ = first_command - static_cast<std::int64_t>(kind); }
  void end() { now_ = none; }

  // "step 1201", "the command 'load'"; "the step loop" between the two.
  std::string text() const;

 private:
  static constexpr std::int64_t none = -1;
  static constexpr std::int64_t first_command = -2;  // and downwards; steps are not negative

  std::atomic<std::int64_t> now_ = none;
};

}  // namespace flexcast::server
