// The runs of a study: every setting once against the reference, then again for its time, within a budget.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/lab/trade/trade_reference.h"
#include "core/lab/trade/trade_runner.h"
#include "core/lab/trade/trade_settings.h"

namespace flexcast {

struct TradeResult {
  // skipped: it does not fit the budget. cut: it did not end within several times what was predicted.
  enum class Status { done, failed, skipped, cut };
  TradeSetting setting;
  Status status = Status::skipped;
  std::string cause;            // of anything but done
  double h = 0.0;               // s, step of the integrator; 0 under a contract
  double predicted = 0.0;       // s, a run
  double time = 0.0;            // s, how far it came
  std::vector<double> samples;  // s, of whole runs
  double cost = 0.0;            // wall seconds per simulated second, median
  TradeErrors errors;           // of what is done
  double error = 0.0;           // errors.rms over the motion's size
  bool at_limit = false;        // its error says no more than the reference's own
  bool on_front = false;        // nothing cheaper is as accurate
};

struct SweepSettings {
  const TradeReference* reference = nullptr;
  double motion = 1.0;         // m
  std::optional<int> repeats;  // else as the budget allows
  std::function<void(const std::string& doing)> show = {};
};

const char* name_status(TradeResult::Status status);

// Coarse steps of all groups come first, so that finer ones are predicted from them. Errors: what the loader refuses.
Result<std::vector<TradeResult>> run_sweep(const TradeRunner& runner, const std::vector<TradeGroup>& groups,
                                           const SweepSettings& settings);

}  // namespace flexcast
