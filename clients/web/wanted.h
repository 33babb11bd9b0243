// Which frames somebody wants.
#pragma once

#include <set>
#include <string>

namespace flexcast::web {

struct Wanted {
  bool frames = false;             // of all worlds
  std::set<std::string> points{};  // worlds whose frames are wanted as point clouds, too
  friend bool operator==(const Wanted&, const Wanted&) = default;
};

}  // namespace flexcast::web
