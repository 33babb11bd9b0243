// Frames for the network.
#pragma once

#include <string_view>

#include "idl/wire/owned.h"
#include "server/convert/frame_types.h"

namespace flexcast::server {

// One message, filled anew for each chunk of each frame.
class FrameMessage {
 public:
  explicit FrameMessage(std::string_view world);

  // The frame must stay as long as its chunks are asked for: they show its numbers.
  void assign(const Frame& frame);

  std::uint32_t chunks() const { return message_->chunks; }
  // Valid until the next call.
  const flexcast_ParticleFrame& chunk(std::uint32_t chunk);

 private:
  wire::Owned<flexcast_ParticleFrame> message_;
  const FramePayload* payload_ = nullptr;  // the frame's
};

}  // namespace flexcast::server
