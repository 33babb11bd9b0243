// What a frame shows of a state: the box around it and its numbers as they are sent.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/sim/stream_format.h"

namespace flexcast {

// What there is to send. Fields that the format does not name may be empty.
struct FrameSource {
  const VecX& positions;   // m, 3 n
  const VecX& velocities;  // m/s, 3 n
  const VecX& stretch;     // 1, n
  const VecX& stress;      // Pa, n
};

// Flat arrays; what the format does not name is empty.
struct FramePayload {
  std::array<double, 6> bounds = {};  // m, min x, y, z, max x, y, z; zeros without particles
  std::vector<float> positions, velocities, stretch, stress;
  std::span<const double> positions64, velocities64;  // the source's own
  std::vector<std::uint16_t> positions16;             // nearest q of p = lo + q / 65535 (hi - lo); 0 where hi = lo
};

// The source must stay as long as the payload's views of it are used. Keeps the payload's buffers.
void fill_payload(const FrameSource& source, const StreamFormat& format, FramePayload& payload);

// What a viewer makes of the payload: m, 3 n; empty without positions.
VecX decode_positions(const FramePayload& payload);

}  // namespace flexcast
