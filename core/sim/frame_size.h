// How large frames are on the wire: the layout of ParticleFrame (XCDR1) in numbers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/sim/stream_format.h"

namespace flexcast {

// What the numbers of one particle take.
std::size_t calc_particle_bytes(const StreamFormat& format);

// An upper bound whatever the world is called, and the samples it comes in.
struct FrameSize {
  std::size_t bytes = 0;
  std::uint32_t chunks = 1;
};
FrameSize calc_frame_size(std::int64_t particles, const StreamFormat& format);

// All samples of a frame as they are serialised: the fixed part, the name of the world, sequences with their counts
// and alignment. `name_length` without the final zero.
std::size_t calc_wire_bytes(std::int64_t particles, const StreamFormat& format, std::size_t name_length);

}  // namespace flexcast
