// What is worth choosing: the settings that nothing beats in both time and accuracy, and the cheapest for a demand.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/lab/trade/trade_sweep.h"

namespace flexcast {

// Demands on the error, as fractions of the motion.
inline constexpr std::array<double, 3> trade_levels = {0.1, 0.01, 0.001};

// Sets on_front of what is done.
void mark_front(std::vector<TradeResult>& results);

struct TradeLevel {
  double level = 0.0;
  // Number of the cheapest result whose error and the reference's own together are within the level; -1: none is.
  std::int64_t cheapest = -1;
  bool decidable = true;  // the reference's own error is within the level
};

// own: the reference's error over the motion's size.
std::vector<TradeLevel> find_cheapest(const std::vector<TradeResult>& results, double own);

}  // namespace flexcast
