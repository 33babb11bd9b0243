#include "core/sim/state_hash.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

namespace flexcast {
namespace {

TEST(StateHash, PiecesOfAnyLengthGiveTheHashOfAllTheBytes) {
  const VecX positions = VecX::LinSpaced(3000, -1.0, 1.0), velocities = VecX::LinSpaced(3000, 5.0, 9.0);
  std::vector<char> bytes(sizeof(std::int64_t) + 6000 * sizeof(double));
  const std::int64_t step = 77;
  std::memcpy(bytes.data(), &step, sizeof step);
  std::memcpy(bytes.data() + 8, positions.data(), 3000 * sizeof(double));
  std::memcpy(bytes.data() + 8 + 3000 * sizeof(double), velocities.data(), 3000 * sizeof(double));
  const std::uint64_t expected = XXH3_64bits(bytes.data(), bytes.size());
  EXPECT_EQ(calc_state_hash(step, positions, velocities), expected);
  StateHash hash;
  for (const std::size_t piece : {1u, 3u, 30u, 32u, 33u, 999u, 2040u, 3000u}) {
    hash.begin(step);
    for (const VecX* numbers : {&positions, &velocities}) {
      const std::span all(numbers->data(), 3000);
      for (std::size_t first = 0; first < 3000; first += piece) {
        hash.add(all.subspan(first, std::min<std::size_t>(piece, 3000 - first)));
      }
    }
    EXPECT_EQ(hash.value(), expected) << piece;
  }
}

}  // namespace
}  // namespace flexcast
