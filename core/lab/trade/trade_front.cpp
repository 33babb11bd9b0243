#include "core/lab/trade/trade_front.h"

#include <algorithm>

namespace flexcast {
namespace {

bool is_done(const TradeResult& result) {
  return result.status == TradeResult::Status::done;
}

bool is_beaten_by(const TradeResult& one, const TradeResult& other) {
  const bool no_worse = other.cost <= one.cost && other.error <= one.error;
  return is_done(other) && no_worse && (other.cost < one.cost || other.error < one.error);
}

}  // namespace

void mark_front(std::vector<TradeResult>& results) {
  for (TradeResult& one : results) {
    one.on_front = is_done(one) &&
                   std::ranges::none_of(results, [&](const TradeResult& other) { return is_beaten_by(one, other); });
  }
}

std::vector<TradeLevel> find_cheapest(const std::vector<TradeResult>& results, double own) {
  std::vector<TradeLevel> levels;
  for (const double level : trade_levels) {
    TradeLevel found{level, -1, own < level};
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (!is_done(results[i]) || results[i].error + own > level) continue;
      if (found.cheapest < 0 || results[i].cost < results[static_cast<std::size_t>(found.cheapest)].cost)
        found.cheapest = static_cast<std::int64_t>(i);
    }
    levels.push_back(found);
  }
  return levels;
}

}  // namespace flexcast
