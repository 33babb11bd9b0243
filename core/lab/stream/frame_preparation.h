// What is done with a simulation's state between the step and DDS, but for its hash and copies: fields and conversion.
#pragma once

#include "core/sim/frame_payload.h"
#include "core/sim/particle_fields.h"
#include "core/sim/simulation.h"

namespace flexcast {

// To be timed: prepares the frame of the simulation's present state again and again, in one format.
class FramePreparation {
 public:
  // Keeps references to the simulation's state and model.
  FramePreparation(const Simulation& simulation, const StreamFormat& format)
      : state_(simulation.state()), fields_(simulation.model()), format_(format) {}

  void run() {
    if (format_.stretch) fields_.calc_stretch(state_.positions, stretch_);
    if (format_.stress) fields_.calc_stress(state_.positions, stress_);
    fill_payload({state_.positions, state_.velocities, stretch_, stress_}, format_, payload_);
  }

 private:
  const State& state_;
  ParticleFields fields_;
  StreamFormat format_;
  VecX stretch_, stress_;
  FramePayload payload_;
};

}  // namespace flexcast
