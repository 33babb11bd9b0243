// The fingerprint of a state: XXH3 (64 bit) over step (int64), positions and velocities (doubles), as they lie in
// memory on a little-endian machine.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/state/state.h"

struct XXH3_state_s;

namespace flexcast {

// The same in pieces: begin, add all positions in order, then all velocities; pieces may be of any length.
class StateHash {
 public:
  StateHash();
  void begin(std::int64_t step);
  void add(std::span<const double> numbers);
  std::uint64_t value() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

std::uint64_t calc_state_hash(std::int64_t step, const VecX& positions, const VecX& velocities);
inline std::uint64_t calc_state_hash(const State& state) {
  return calc_state_hash(state.step, state.positions, state.velocities);
}

}  // namespace flexcast
