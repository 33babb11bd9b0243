// FrameRing: frames whose memory is there from the start. Free frames are reused last in, first out, so that a reader
// that keeps up touches the memory of two frames only. Not for several threads: frame_mailbox.h is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/convert/frame_types.h"

namespace flexcast::server {

struct FrameLimits {
  std::size_t frames = 64;
  std::size_t bytes = std::size_t{256} << 20;  // as many frames as fit in here
  std::size_t least = 4;                       // but so many in any case
};

class FrameRing {
 public:
  FrameRing(std::int64_t particles, const StreamFormat& format, const FrameLimits& limits);

  std::size_t capacity() const { return frames_.size(); }
  std::size_t waiting() const { return waiting_; }

  Frame* acquire();            // a free frame to fill; null: there is none
  void commit(Frame* frame);   // filled: it waits to be taken
  Frame* take();               // the oldest that waits, no longer waiting; null: none
  void release(Frame* frame);  // free again

 private:
  std::vector<Frame> frames_;
  std::vector<Frame*> free_;   // a stack
  std::vector<Frame*> queue_;  // circular
  std::size_t head_ = 0;
  std::size_t waiting_ = 0;
};

}  // namespace flexcast::server
