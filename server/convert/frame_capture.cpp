#include "server/convert/frame_capture.h"

#include "core/base/checks.h"

namespace flexcast::server {

void FrameCapture::fill(const FrameHeader& header, const State& state, ParticleFields* fields, Frame& frame) {
  const StreamFormat& format = header.format;
  FLEXCAST_CHECK(state.velocities.size() == state.positions.size());
  FLEXCAST_CHECK(fields != nullptr || !(format.stretch || format.stress));
  if (format.stretch) fields->calc_stretch(state.positions, stretch_);
  if (format.stress) fields->calc_stress(state.positions, stress_);
  frame.header = header;
  frame.particles = static_cast<std::uint32_t>(state.positions.size() / 3);
  hash_.begin(header.step);
  fill_payload({state.positions, state.velocities, stretch_, stress_}, format, frame.payload, &hash_);
  frame.state_hash = hash_.value();
}

}  // namespace flexcast::server
