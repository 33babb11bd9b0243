// One published step, free of DDS.
#pragma once

#include <cstdint>

#include "core/sim/frame_payload.h"

namespace flexcast::server {

struct FrameHeader {
  std::uint64_t run_id = 0;
  std::uint64_t frame = 0;  // 0, 1, 2, ... within a run
  std::int64_t step = 0;
  double time = 0.0;  // s
  std::uint64_t parameter_revision = 0;
  std::uint64_t topology_revision = 1;
  StreamFormat format;
};

struct Frame {
  FrameHeader header;
  std::uint32_t particles = 0;
  std::uint64_t state_hash = 0;  // of the doubles, whatever the format
  FramePayload payload;          // what the format names
};

}  // namespace flexcast::server
