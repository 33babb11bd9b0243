// FrameTally: what a subscriber has got of one world's frames: how many, which are missing, how long they took.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "idl/wire/types.h"

namespace flexcast::bench {

// Seconds of the clock that all processes of a machine share.
double monotonic_seconds();

class FrameTally {
 public:
  // Chunks may come in any order. `time` of a frame is when its step ended, by monotonic_seconds().
  void add(const flexcast_ParticleFrame& chunk);

  std::uint64_t frames() const { return frames_; }  // whole ones
  // Those between the first and the newest that never became whole; some may be under way.
  std::uint64_t missing() const { return begun_ ? newest_ + 1 - first_ - frames_ : 0; }
  const std::vector<double>& latencies() const { return latencies_; }  // s, of each frame

 private:
  bool begun_ = false;
  std::uint64_t first_ = 0, newest_ = 0;            // whole ones
  std::map<std::uint64_t, std::uint32_t> partial_;  // frame, chunks that have come
  std::uint64_t frames_ = 0;
  std::vector<double> latencies_;
};

}  // namespace flexcast::bench
