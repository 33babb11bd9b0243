#include "server/run_ids.h"

#include <algorithm>
#include <chrono>

namespace flexcast::server {

RunIds::RunIds()
    : RunIds([] {
        const auto now = std::chrono::system_clock::now().time_since_epoch();
        return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
      }) {}

std::uint64_t RunIds::next() {
  return last_ = std::max(now_(), last_ + 1);
}

}  // namespace flexcast::server
