#include "server/unpublished_frames.h"

#include "core/base/checks.h"

namespace flexcast::server {

void UnpublishedFrames::note(std::uint64_t number, bool published) {
  FLEXCAST_CHECK(number >= next_);
  const std::uint64_t end = published ? number : number + 1;
  if (end > next_) add(next_, end - 1);
  next_ = number + 1;
}

void UnpublishedFrames::note_newest_published() {
  if (ranges_.empty() || ranges_.back().last + 1 != next_) return;
  if (ranges_.back().first == ranges_.back().last) {
    ranges_.pop_back();
  } else {
    --ranges_.back().last;
  }
}

void UnpublishedFrames::clear() {
  next_ = 0;
  ranges_.clear();
}

void UnpublishedFrames::add(std::uint64_t first, std::uint64_t last) {
  if (!ranges_.empty() && ranges_.back().last + 1 == first) {
    ranges_.back().last = last;
    return;
  }
  if (ranges_.size() == most_ranges) ranges_.erase(ranges_.begin());
  ranges_.push_back({first, last});
}

}  // namespace flexcast::server
