// FrameCapture: takes the picture of a state that is published: one pass over it, while the step has left it in the
// caches, and less to keep than the state itself.
#pragma once

#include "core/sim/particle_fields.h"
#include "core/sim/state_hash.h"
#include "core/state/state.h"
#include "server/convert/frame_types.h"

namespace flexcast::server {

class FrameCapture {
 public:
  // Keeps the frame's buffers. `fields` is of the state's model; not needed by formats without stretch and stress.
  void fill(const FrameHeader& header, const State& state, ParticleFields* fields, Frame& frame);

 private:
  StateHash hash_;
  VecX stretch_, stress_;
};

}  // namespace flexcast::server
