// flexcast-lab: parses its command line and calls the verb.
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <iostream>

#include "core/lab/options.h"
#include "core/lab/trade/trade.h"

namespace {
std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler writes it

void request_stop(int) {
  stop = true;
}
}  // namespace

int main(int argc, char** argv) {
  flexcast::LabCommand command = flexcast::parse_lab_command({argv + 1, argv + argc});
  if (const auto* end = std::get_if<flexcast::CommandLineEnd>(&command)) {
    (end->exit_code == 0 ? std::cout : std::cerr) << end->text;
    return end->exit_code;
  }
  const bool terminal = isatty(STDERR_FILENO) != 0;
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  if (auto* modes = std::get_if<flexcast::ModesOptions>(&command)) {
    modes->stop = &stop;
    return flexcast::modes_verb(*modes, std::cout, std::cerr);
  }
  if (auto* bench = std::get_if<flexcast::BenchOptions>(&command)) {
    bench->stop = &stop;
    return flexcast::bench_verb(*bench, std::cout, std::cerr);
  }
  if (const auto* plot = std::get_if<flexcast::PlotOptions>(&command)) return flexcast::plot_verb(*plot, std::cerr);
  if (auto* limits = std::get_if<flexcast::LimitsOptions>(&command)) {
    limits->stop = &stop;
    limits->progress = terminal;
    return flexcast::limits_verb(*limits, std::cout, std::cerr);
  }
  if (auto* stream = std::get_if<flexcast::StreamTradeOptions>(&command)) {
    stream->stop = &stop;
    stream->progress = terminal;
    return flexcast::stream_trade_verb(*stream, std::cout, std::cerr);
  }
  if (auto* cost = std::get_if<flexcast::SceneCostOptions>(&command)) {
    cost->stop = &stop;
    cost->progress = terminal;
    return flexcast::scene_cost_verb(*cost, std::cout, std::cerr);
  }
  if (auto* trade = std::get_if<flexcast::TradeOptions>(&command)) {
    trade->stop = &stop;
    trade->progress = terminal;
    return flexcast::trade_verb(*trade, std::cout, std::cerr);
  }
  auto& options = std::get<flexcast::RunOptions>(command);
  options.stop = &stop;
  options.progress = terminal;
  return flexcast::run_verb(options, std::cout, std::cerr);
}
