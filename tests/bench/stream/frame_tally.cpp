#include "tests/bench/stream/frame_tally.h"

#include <algorithm>
#include <chrono>

namespace flexcast::bench {

double monotonic_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void FrameTally::add(const flexcast_ParticleFrame& chunk) {
  if (++partial_[chunk.frame] != chunk.chunks) return;
  partial_.erase(chunk.frame);
  latencies_.push_back(monotonic_seconds() - chunk.time);
  if (!begun_) first_ = newest_ = chunk.frame;
  begun_ = true;
  first_ = std::min<std::uint64_t>(first_, chunk.frame);
  newest_ = std::max<std::uint64_t>(newest_, chunk.frame);
  ++frames_;
}

}  // namespace flexcast::bench
