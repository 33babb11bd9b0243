// What the frames of a scene's stream carry, and how exactly.
#pragma once

#include "core/sim/settings.h"

namespace flexcast {

enum class StreamPrecision {
  float32,
  float64,     // positions and velocities as the engine has them
  quantized16  // positions as fractions of the frame's bounds in 16 bits, velocities in single precision
};

struct StreamFormat {
  bool positions = true;
  bool velocities = false;
  StreamPrecision precision = StreamPrecision::float32;  // of positions and velocities
  bool stretch = false, stress = false;                  // see particle_fields.h; always in single precision
};

StreamFormat make_stream_format(const StreamSettings& settings);

}  // namespace flexcast
