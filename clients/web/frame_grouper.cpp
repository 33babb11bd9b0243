#include "clients/web/frame_grouper.h"

#include <algorithm>

namespace flexcast::web {

std::optional<WholeFrame> FrameGrouper::add(const wire::FrameHead& head, Sample chunk) {
  if (last_ && last_->first == head.run_id && head.frame <= last_->second) return {};
  if (head.chunk >= head.chunks || head.chunks > most_chunks) return {};
  Partial& partial = find_or_begin(head);
  auto& chunks = partial.frame.chunks;
  if (chunks.size() != head.chunks || chunks[head.chunk].bytes.size() > 0) return {};
  chunks[head.chunk] = std::move(chunk);
  if (--partial.missing > 0) return {};
  return finish(partial);
}

FrameGrouper::Partial& FrameGrouper::find_or_begin(const wire::FrameHead& head) {
  for (Partial& partial : partials_)
    if (partial.frame.run_id == head.run_id && partial.frame.frame == head.frame) return partial;
  if (partials_.size() == most_partials) partials_.pop_front();
  partials_.push_back(
      {{.run_id = head.run_id, .frame = head.frame, .chunks = std::vector<Sample>(head.chunks)}, head.chunks});
  return partials_.back();
}

WholeFrame FrameGrouper::finish(const Partial& partial) {
  WholeFrame frame = partial.frame;
  last_ = {frame.run_id, frame.frame};
  std::erase_if(partials_, [&](const Partial& other) {
    return other.frame.run_id == frame.run_id && other.frame.frame <= frame.frame;
  });
  return frame;
}

}  // namespace flexcast::web
