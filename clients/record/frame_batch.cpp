#include "clients/record/frame_batch.h"

#include <algorithm>
#include <tuple>

namespace flexcast::record {

void FrameBatch::clear() {
  arrivals_.clear();
  bytes_ = 0;
}

bool FrameBatch::add(const wire::RawSample& sample) {
  auto head = wire::peek_frame_head(sample.bytes);
  if (!head) return false;
  head.value().world = {};  // lives as long as the sample's bytes
  const auto sequence = static_cast<std::uint32_t>(head.value().frame);
  arrivals_.push_back({head.value(), sample.info.writer, make_message(wire::TopicId::frames, sequence, sample)});
  bytes_ += sample.bytes.size();
  return true;
}

void FrameBatch::sort(std::uint64_t current_run) {
  std::vector<std::uint64_t> runs{current_run};  // in the order in which they are met
  const auto rank = [&](std::uint64_t run_id) { return std::find(runs.begin(), runs.end(), run_id) - runs.begin(); };
  for (const Arrival& arrival : arrivals_) {
    if (rank(arrival.head.run_id) == std::ssize(runs)) runs.push_back(arrival.head.run_id);
  }
  const auto earlier = [&](const Arrival& a, const Arrival& b) {
    return std::tuple(rank(a.head.run_id), a.head.frame, a.head.chunk) <
           std::tuple(rank(b.head.run_id), b.head.frame, b.head.chunk);
  };
  if (!std::is_sorted(arrivals_.begin(), arrivals_.end(), earlier)) {
    std::stable_sort(arrivals_.begin(), arrivals_.end(), earlier);
  }
}

}  // namespace flexcast::record
