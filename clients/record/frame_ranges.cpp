#include "clients/record/frame_ranges.h"

#include <algorithm>
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

void FrameRanges::add(const FrameRange& range) {
  std::uint64_t first = range.first, last = range.last;
  auto at = ranges_.upper_bound(first);
  if (at != ranges_.begin()) {
    const auto before = std::prev(at);
    if (before->second >= first || before->second + 1 == first) at = before;
  }
  while (at != ranges_.end() && (at->first <= last || at->first - 1 == last)) {
    first = std::min(first, at->first);
    last = std::max(last, at->second);
    size_ -= at->second - at->first + 1;
    at = ranges_.erase(at);
  }
  ranges_.emplace(first, last);
  size_ += last - first + 1;
}

void FrameRanges::remove(std::uint64_t frame) {
  const auto next = ranges_.upper_bound(frame);
  if (next == ranges_.begin()) return;
  const auto [first, last] = *std::prev(next);
  if (last < frame) return;
  ranges_.erase(first);
  --size_;
  if (first < frame) ranges_.emplace(first, frame - 1);
  if (frame < last) ranges_.emplace(frame + 1, last);
}

std::vector<FrameRange> FrameRanges::ranges() const {
  std::vector<FrameRange> list;
  for (const auto& [first, last] : ranges_) list.push_back({first, last});
  return list;
}

std::vector<FrameRange> FrameRanges::ranges_from(std::uint64_t frame) const {
  std::vector<FrameRange> list;
  auto at = ranges_.upper_bound(frame);
  if (at != ranges_.begin() && std::prev(at)->second >= frame) --at;
  for (; at != ranges_.end(); ++at) list.push_back({std::max(at->first, frame), at->second});
  return list;
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
