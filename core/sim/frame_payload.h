// What a frame shows of a state: the box around it and its numbers as they are sent.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/math.h"
#include "core/sim/state_hash.h"
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
  std::vector<double> positions64, velocities64;
  std::vector<std::uint16_t> positions16;  // nearest q of p = lo + q / 65535 (hi - lo); 0 where hi = lo
};

// Gets the memory, so that filling the payload allocates none; does not touch it.
void reserve_payload(std::int64_t particles, const StreamFormat& format, FramePayload& payload);

// Keeps the payload's buffers. `hash`, which has begun, gets positions and velocities on the way.
void fill_payload(const FrameSource& source, const StreamFormat& format, FramePayload& payload,
                  StateHash* hash = nullptr);

// What a viewer makes of the payload: m, 3 n; empty without positions.
VecX decode_positions(const FramePayload& payload);

}  // namespace flexcast
