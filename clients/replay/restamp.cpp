#include "clients/replay/restamp.h"

#include <algorithm>
#include <vector>

namespace flexcast::replay {

bool restamp(flexcast_ParticleFrame& frame, const Stamp& stamp) {
  const auto run = stamp.runs.find(frame.run_id);
  if (!run || frame.frame < run->first || !restamp<flexcast_ParticleFrame>(frame, stamp)) return false;
  frame.frame -= run->first;
  return true;
}

bool restamp(flexcast_Status& status, const Stamp& stamp) {
  const auto run = stamp.runs.find(status.run_id);
  if (!run || !restamp<flexcast_Status>(status, stamp)) return false;
  // Ranges of frame numbers: what lies before the first frame is not of this run any more.
  std::vector<std::uint64_t> ranges;
  const auto unpublished = wire::elements(status.unpublished);
  for (std::size_t i = 0; i + 1 < unpublished.size(); i += 2) {
    if (unpublished[i + 1] < run->first) continue;
    ranges.push_back(std::max(unpublished[i], run->first) - run->first);
    ranges.push_back(unpublished[i + 1] - run->first);
  }
  wire::copy(status.unpublished, ranges);
  return true;
}

}  // namespace flexcast::replay
