// Clips: the parts of a recording's runs that are shown.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "clients/recording/index.h"

namespace flexcast::replay {

// Frames of one run, by their place in Index::frames().
struct Clip {
  std::uint64_t run_id = 0;  // as recorded
  std::size_t begin = 0;
  std::size_t end = 0;      // behind the last; at least one frame
  bool from_start = false;  // nothing of the run is left out before it ...
  bool to_end = false;      // ... or behind it
};

// Whether a frame's time has reached a time that a person wrote: 0.3 is reached by 3 x 0.1, too, whatever the rounding.
inline bool has_reached(double time, double wanted) {
  return time >= wanted - 1e-9 * std::max(1.0, std::abs(wanted));
}

// Of each run the frames from the first one at or after `from` to the last one before the first that lies after `to`.
// Runs without such frames are left out.
std::vector<Clip> make_clips(const recording::Index& index, std::optional<double> from, std::optional<double> to);

}  // namespace flexcast::replay
