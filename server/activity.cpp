#include "server/activity.h"

#include <array>
#include <cstddef>

namespace flexcast::server {

std::string Activity::text() const {
  constexpr std::array names{"set",       "get",  "describe", "reset",   "pause", "resume",  "step",
                             "run-until", "load", "save",     "restore", "grab",  "release", "status"};
  static_assert(names.size() == static_cast<std::size_t>(CommandKind::status) + 1);
  const std::int64_t now = now_;
  if (now == none) return "the step loop";
  if (now >= 0) return "step " + std::to_string(now);
  return std::string("the command '") + names.at(static_cast<std::size_t>(first_command - now)) + "'";
}

}  // namespace flexcast::server
