// Colours for particles such that none feels another of its own colour.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/forces/block_runs.h"

namespace flexcast {

using Couplings = std::vector<std::pair<std::int32_t, std::int32_t>>;

// Greedy, in the order of the particles: the particles of each colour, rising. Deterministic.
std::vector<std::vector<std::int32_t>> make_colors(std::int32_t particles, Couplings couplings);

// The colours one after the other, each in runs of particles. Those that couple as often are neighbours, within
// stretches of a colour that are short enough to leave neighbours in space together.
struct VisitOrder {
  Visits visits;
  std::vector<std::int32_t> color_starts;  // the first run of each colour, and the end of the last one

  VisitOrder(std::int32_t particles, Couplings couplings);
};

}  // namespace flexcast
