#include "server/frame_ring.h"

#include <algorithm>

#include "core/base/checks.h"
#include "core/sim/frame_size.h"

namespace flexcast::server {

FrameRing::FrameRing(std::int64_t particles, const StreamFormat& format, const FrameLimits& limits) {
  const std::size_t frame_bytes =
      std::max<std::size_t>(1, calc_particle_bytes(format) * static_cast<std::size_t>(particles));
  const std::size_t count = std::max(limits.least, std::min(limits.frames, limits.bytes / frame_bytes));
  frames_.resize(count);
  queue_.resize(count);
  for (Frame& frame : frames_) {
    reserve_payload(particles, format, frame.payload);  // the system gives memory only to the frames that are used
    free_.push_back(&frame);
  }
}

Frame* FrameRing::acquire() {
  if (free_.empty()) return nullptr;
  Frame* frame = free_.back();
  free_.pop_back();
  return frame;
}

void FrameRing::commit(Frame* frame) {
  FLEXCAST_CHECK(waiting_ < queue_.size());
  queue_[(head_ + waiting_) % queue_.size()] = frame;
  ++waiting_;
}

Frame* FrameRing::take() {
  if (waiting_ == 0) return nullptr;
  Frame* frame = queue_[head_];
  head_ = (head_ + 1) % queue_.size();
  --waiting_;
  return frame;
}

void FrameRing::release(Frame* frame) {
  FLEXCAST_CHECK(free_.size() < frames_.size());
  free_.push_back(frame);
}

}  // namespace flexcast::server
