// The order of convergence that a group of settings shows.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/lab/trade/trade_sweep.h"

namespace flexcast {

struct ObservedOrder {
  double order = 0.0;
  int settings = 0;  // that show it
};

// The slope of log(error) over log(h) by least squares, over the finest run of neighbours whose slopes from one to the
// next are within 0.2 of the finest one's: an order is what remains as h goes to zero. Points fall in h. Nothing where
// no three points make such a run, or where finer steps gain nothing.
std::optional<ObservedOrder> calc_order(const std::vector<std::array<double, 2>>& points);

// Of what is done, more accurate than 20 % of the motion and not at the reference's limit.
std::optional<ObservedOrder> calc_order(const std::vector<TradeResult>& results, std::size_t group);

}  // namespace flexcast
