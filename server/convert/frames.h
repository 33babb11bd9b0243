// Frames for the network.
#pragma once

#include <string_view>

#include "core/sim/frame_payload.h"
#include "idl/wire/owned.h"
#include "server/convert/frame_types.h"

namespace flexcast::server {

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
  FramePayload payload_;
};

}  // namespace flexcast::server
