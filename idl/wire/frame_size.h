// How large a world's frames are, from what its SceneInfo says. For readers that size their queues.
#pragma once

#include <cstddef>
#include <cstdint>

#include "idl/wire/types.h"

namespace flexcast::wire {

// A larger frame is split by particle range into chunks of at most this size.
inline constexpr std::size_t largest_sample = std::size_t{1} << 20;

struct FrameSize {
  std::size_t bytes = 0;     // all chunks, without the heads
  std::uint32_t chunks = 1;  // a lower bound: particles are not divided
};

FrameSize frame_size(const flexcast_SceneInfo& scene);

}  // namespace flexcast::wire
