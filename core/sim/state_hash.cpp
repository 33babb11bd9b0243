#include "core/sim/state_hash.h"

#include <xxhash.h>
#if defined(__x86_64__)
#include <xxh_x86dispatch.h>  // takes the widest vectors of the machine; the values are the same
#endif

#include <memory>

#include "core/base/checks.h"

namespace flexcast {

std::uint64_t calc_state_hash(std::int64_t step, const VecX& positions, const VecX& velocities) {
  thread_local const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), XXH3_freeState);
  FLEXCAST_CHECK(hash != nullptr);
  XXH3_64bits_reset(hash.get());
  XXH3_64bits_update(hash.get(), &step, sizeof step);
  XXH3_64bits_update(hash.get(), positions.data(), sizeof(double) * static_cast<std::size_t>(positions.size()));
  XXH3_64bits_update(hash.get(), velocities.data(), sizeof(double) * static_cast<std::size_t>(velocities.size()));
  return XXH3_64bits_digest(hash.get());
}

}  // namespace flexcast
