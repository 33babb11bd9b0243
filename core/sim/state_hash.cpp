#include "core/sim/state_hash.h"

#include <xxhash.h>
#if defined(__x86_64__)
#include <xxh_x86dispatch.h>  // takes the widest vectors of the machine; the values are the same
#endif

#include "core/base/checks.h"

namespace flexcast {

void StateHash::Free::operator()(XXH3_state_s* state) const {
  XXH3_freeState(state);
}

StateHash::StateHash() : state_(XXH3_createState()) {
  FLEXCAST_CHECK(state_ != nullptr);
}

void StateHash::begin(std::int64_t step) {
  XXH3_64bits_reset(state_.get());
  XXH3_64bits_update(state_.get(), &step, sizeof step);
}

void StateHash::add(std::span<const double> numbers) {
  XXH3_64bits_update(state_.get(), numbers.data(), numbers.size_bytes());
}

std::uint64_t StateHash::value() const {
  return XXH3_64bits_digest(state_.get());
}

std::uint64_t calc_state_hash(std::int64_t step, const VecX& positions, const VecX& velocities) {
  thread_local StateHash hash;
  hash.begin(step);
  hash.add({positions.data(), static_cast<std::size_t>(positions.size())});
  hash.add({velocities.data(), static_cast<std::size_t>(velocities.size())});
  return hash.value();
}

}  // namespace flexcast
