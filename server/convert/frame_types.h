// One published step, free of DDS.
#pragma once

#include <cstdint>

#include "core/base/math.h"
#include "core/sim/settings.h"

namespace flexcast::server {

// What a frame shows to the network.
struct StreamFormat {
  bool positions = true;
  bool velocities = false;
  bool doubles = false;  // float64 instead of float32
};

StreamFormat make_stream_format(const StreamSettings& settings);

struct FrameHeader {
  std::uint64_t run_id = 0;
  std::uint64_t frame = 0;  // 0, 1, 2, ... within a run
  std::int64_t step = 0;
  double time = 0.0;  // s
  std::uint64_t parameter_revision = 0;
  std::uint64_t topology_revision = 1;
  StreamFormat format;
};

// Velocities are there whatever the format: the state's hash needs them.
struct Frame {
  FrameHeader header;
  VecX positions;   // m, 3 n
  VecX velocities;  // m/s, 3 n
};

}  // namespace flexcast::server
