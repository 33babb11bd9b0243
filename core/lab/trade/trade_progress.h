// What a study is at, and how much of its budget is left, on one line of a terminal.
#pragma once

#include <iosfwd>
#include <string>

#include "core/lab/trade/trade_clock.h"

namespace flexcast {

class TradeProgress {
 public:
  TradeProgress(std::ostream& log, bool active, const TradeBudget& budget)
      : log_(log), active_(active), budget_(budget) {}
  ~TradeProgress();  // wipes the line
  TradeProgress(const TradeProgress&) = delete;
  TradeProgress& operator=(const TradeProgress&) = delete;

  void show(const std::string& doing);

 private:
  std::ostream& log_;
  bool active_, shown_ = false;
  const TradeBudget& budget_;
};

}  // namespace flexcast
