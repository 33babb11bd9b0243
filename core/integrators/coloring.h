// Colours for particles such that none feels another of its own colour.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace flexcast {

// Greedy, in the order of the particles: the particles of each colour, rising. Deterministic.
std::vector<std::vector<std::int32_t>> make_colors(std::int32_t particles,
                                                   std::vector<std::pair<std::int32_t, std::int32_t>> couplings);

}  // namespace flexcast
