// The fingerprint of a state: XXH3 (64 bit) over step (int64), positions and velocities (doubles), as they lie in
// memory on a little-endian machine.
#pragma once

#include "core/state/state.h"

namespace flexcast {
std::uint64_t calc_state_hash(std::int64_t step, const VecX& positions, const VecX& velocities);
inline std::uint64_t calc_state_hash(const State& state) {
  return calc_state_hash(state.step, state.positions, state.velocities);
}
}  // namespace flexcast
