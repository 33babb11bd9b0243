#include "clients/record/frame_ranges.h"

#include <iterator>
#include <limits>

namespace flexcast::record {

void FrameRanges::add(std::uint64_t frame) {
  auto next = ranges_.upper_bound(frame);
  auto before = next == ranges_.begin() ? ranges_.end() : std::prev(next);
  if (before != ranges_.end() && before->second >= frame) return;
  ++size_;
  // `before` ends below `frame`, so neither sum can overflow.
  const bool joins_before = before != ranges_.end() && before->second + 1 == frame;
  const bool joins_next = next != ranges_.end() && frame + 1 == next->first;
  const std::uint64_t last = joins_next ? next->second : frame;
  if (joins_next) ranges_.erase(next);
  if (joins_before) {
    before->second = last;
  } else {
    ranges_.emplace(frame, last);
  }
}

FrameRanges::Stretch FrameRanges::stretch(std::uint64_t frame) const {
  const auto next = ranges_.upper_bound(frame);
  if (next != ranges_.begin()) {
    const auto before = std::prev(next);
    if (before->second >= frame) return {true, before->second};
  }
  return {false, next == ranges_.end() ? std::numeric_limits<std::uint64_t>::max() : next->first - 1};
}

}  // namespace flexcast::record
