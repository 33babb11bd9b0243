// FLEXCAST_CHECK(condition): our own promises. A violated one is a bug in flexcast; the program says where and stops.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace flexcast::detail {
[[noreturn]] inline void check_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "flexcast: internal error: %s does not hold (%s:%d)\n", condition, file, line);
  std::abort();
}
}  // namespace flexcast::detail

#define FLEXCAST_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::flexcast::detail::check_failed(#condition, __FILE__, __LINE__))
