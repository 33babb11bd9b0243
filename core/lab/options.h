// The command line of flexcast-lab.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/lab/bench/bench.h"
#include "core/lab/cost/scene_cost.h"
#include "core/lab/limits/limits.h"
#include "core/lab/modes.h"
#include "core/lab/plot/plot_verb.h"
#include "core/lab/run.h"
#include "core/lab/stream/stream_trade.h"
#include "core/lab/trade/trade_options.h"

namespace flexcast {

// The command line is answered already (--help, --version) or wrong: text to show and the exit code, 0 or 2.
struct CommandLineEnd {
  std::string text;
  int exit_code = 0;
};

// One alternative a verb.
using LabCommand = std::variant<CommandLineEnd, RunOptions, ModesOptions, BenchOptions, PlotOptions, LimitsOptions,
                                TradeOptions, StreamTradeOptions, SceneCostOptions>;

LabCommand parse_lab_command(const std::vector<std::string>& arguments);

}  // namespace flexcast
