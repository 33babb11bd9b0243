// Frames for the network.
#pragma once

#include <string_view>
#include <vector>

#include "idl/wire/owned.h"
#include "server/convert/frame_types.h"

namespace flexcast::server {

// What one frame takes on the wire, and in how many samples.
struct FrameSize {
  std::size_t bytes = 0;
  std::uint32_t chunks = 1;
};
FrameSize calc_frame_size(std::int64_t particles, const StreamFormat& format);

// One message, filled anew for each chunk of each frame. Keeps its buffers.
class FrameMessage {
 public:
  explicit FrameMessage(std::string_view world);

  // Converts the frame (which must stay as long as its chunks are asked for) and calculates its hash and bounds.
  void assign(const Frame& frame);

  std::uint32_t chunks() const { return message_->chunks; }
  // Valid until the next call.
  const flexcast_ParticleFrame& chunk(std::uint32_t chunk);

 private:
  wire::Owned<flexcast_ParticleFrame> message_;
  const Frame* frame_ = nullptr;
  std::vector<float> positions_, velocities_;  // of float32 streams
};

}  // namespace flexcast::server
