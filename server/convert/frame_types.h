// One published step, free of DDS.
#pragma once

#include <cstdint>

#include "core/base/math.h"
#include "core/sim/stream_format.h"

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

// Positions and velocities are there whatever the format: the state's hash needs them.
struct Frame {
  FrameHeader header;
  VecX positions;   // m, 3 n
  VecX velocities;  // m/s, 3 n
  VecX stretch;     // 1, n, when the format has it
  VecX stress;      // Pa, n, likewise
};

}  // namespace flexcast::server
