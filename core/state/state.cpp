#include "core/state/state.h"

#include <cmath>

namespace flexcast {

bool is_publishable(const State& state) {
  // Comparisons with NaN are false, so the largest magnitude is asked for entry by entry.
  const auto all_good = [](const VecX& v) {
    bool good = true;
    for (std::int64_t i = 0; i < v.size(); ++i) good &= std::abs(v[i]) <= largest_magnitude;
    return good;
  };
  return all_good(state.positions) && all_good(state.velocities);
}

}  // namespace flexcast
