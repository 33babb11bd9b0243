// One run of one setting: its time, and what it has to show at the times that are compared.
#pragma once

#include <functional>
#include <string>

#include "core/lab/trade/trade_clock.h"
#include "core/lab/trade/trade_times.h"
#include "core/sim/simulation.h"

namespace flexcast {

struct TradeRun {
  // cut: it took longer than allowed. stopped: the user did not want to wait.
  enum class End { done, failed, cut, stopped };
  End end = End::done;
  double seconds = 0.0;  // in Simulation::step
  double time = 0.0;     // s, simulated
  std::string cause;     // of a failure
};

// Steps to the last of the times; `show` sees the simulation at each of them, outside the seconds that count. The
// scene's step is a multiple of times.frame that divides the distances of the times.
TradeRun run_to_end(Simulation& simulation, const TradeTimes& times, const TradeBudget& budget, double most_seconds,
                    const std::function<void(std::size_t number)>& show = {});

}  // namespace flexcast
