// Run ids of a replay's own: nanoseconds of the system clock since 1970, strictly increasing whatever that clock does.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace flexcast::replay {

inline std::uint64_t system_nanoseconds() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

class RunIds {
 public:
  std::uint64_t next() { return last_ = std::max(system_nanoseconds(), last_ + 1); }

  // All that follow are newer than this one.
  void skip(std::uint64_t run_id) { last_ = std::max(last_, run_id); }

 private:
  std::uint64_t last_ = 0;
};

}  // namespace flexcast::replay
