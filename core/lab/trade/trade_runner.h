// Runs of a study of trades: loads a setting, times it, compares it.
#pragma once

#include <memory>

#include "core/lab/trade/trade_clock.h"
#include "core/lab/trade/trade_frames.h"
#include "core/lab/trade/trade_meshes.h"
#include "core/lab/trade/trade_options.h"
#include "core/lab/trade/trade_run.h"
#include "core/lab/trade/trade_times.h"

namespace flexcast {

class TradeRunner {
 public:
  // Keeps references to all of them.
  TradeRunner(const TradeOptions& options, const TradeMeshes& meshes, const TradeTimes& times,
              const TradeBudget& budget)
      : options_(options), meshes_(meshes), times_(times), budget_(budget) {}

  const TradeTimes& times() const { return times_; }
  const TradeBudget& budget() const { return budget_; }
  const TradeMeshes& meshes() const { return meshes_; }

  // The scene with the options' overrides and then these.
  Result<std::unique_ptr<Simulation>> load(const std::vector<std::string>& overrides) const;

  // s of one integrator step of `h` seconds, from a few of them; without h of one step of the scene. A first step that
  // already takes `most_seconds` is the answer.
  Result<double> probe(std::vector<std::string> overrides, std::optional<double> h, double most_seconds) const;

  TradeFrame make_frame(const Simulation& simulation, std::size_t mesh) const;

  // A whole run that keeps its frames.
  Result<TradeRun> record(const std::vector<std::string>& overrides, std::size_t mesh, double most_seconds,
                          TradeFrames& frames) const;

  // A whole run against a reference.
  Result<TradeRun> compare(const std::vector<std::string>& overrides, std::size_t mesh, double most_seconds,
                           const TradeFrames& reference, TradeErrors& errors) const;

  // A whole run for its time alone.
  Result<TradeRun> time(const std::vector<std::string>& overrides, double most_seconds) const;

 private:
  const TradeOptions& options_;
  const TradeMeshes& meshes_;
  const TradeTimes& times_;
  const TradeBudget& budget_;
};

}  // namespace flexcast
