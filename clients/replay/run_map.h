// RunMap: under which run id, and from which number on, the frames of each recorded run are published.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace flexcast::replay {

class RunMap {
 public:
  struct Run {
    std::uint64_t run_id = 0;  // published
    std::uint64_t first = 0;   // recorded number of the frame that is published as 0
  };

  // Every run as it was recorded.
  RunMap() = default;

  // From now on only runs that were added are published. The first addition of a run counts.
  void add(std::uint64_t recorded_run_id, const Run& run) {
    as_recorded_ = false;
    runs_.emplace(recorded_run_id, run);
  }

  // None: that run is not published.
  std::optional<Run> find(std::uint64_t recorded_run_id) const {
    if (as_recorded_) return Run{recorded_run_id, 0};
    const auto found = runs_.find(recorded_run_id);
    return found == runs_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  bool as_recorded_ = true;
  std::map<std::uint64_t, Run> runs_;
};

}  // namespace flexcast::replay
