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

// The slope of log(error) over log(h) by least squares, over the longest run of neighbours whose slopes from one to the
// next differ by at most 0.3; the finer of two runs of one length. Points fall in h. Nothing for fewer than three
// points in such a run, or where finer steps gain nothing.
std::optional<ObservedOrder> calc_order(const std::vector<std::array<double, 2>>& points);

// Of what is done, more accurate than 20 % of the motion and not at the reference's limit.
std::optional<ObservedOrder> calc_order(const std::vector<TradeResult>& results, std::size_t group);

}  // namespace flexcast
