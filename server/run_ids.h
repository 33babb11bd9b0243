// Run ids: nanoseconds of the system clock since 1970, and strictly increasing whatever that clock does.
#pragma once

#include <cstdint>
#include <functional>

namespace flexcast::server {

class RunIds {
 public:
  using Now = std::function<std::uint64_t()>;

  RunIds();  // the system clock
  explicit RunIds(Now now) : now_(std::move(now)) {}

  std::uint64_t next();

 private:
  Now now_;
  std::uint64_t last_ = 0;
};

}  // namespace flexcast::server
