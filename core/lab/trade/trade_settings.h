// The sweep of a study of trades: groups of settings that differ in their time step only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/integrators/integrator.h"
#include "core/lab/trade/trade_meshes.h"
#include "core/lab/trade/trade_options.h"
#include "core/scene/scene.h"

namespace flexcast {

// A step of an integrator: a frame of the scene in equal parts, or several frames at once.
struct TradeStep {
  std::int64_t frames = 1;  // > 1 only where substeps = 1
  int substeps = 1;
  bool above_limit = false;  // of stability

  double calc_seconds(double frame) const { return frame * static_cast<double>(frames) / substeps; }
};

struct TradeGroup {
  const IntegratorRow* row = nullptr;
  std::optional<int> iterations;    // of xpbd and vbd
  bool linearly_implicit = false;   // one Newton iteration
  std::optional<double> tolerance;  // of the contract; then there is one step, and it means nothing
  std::size_t mesh = 0;
  std::string name;              // what the settings have in common: "rk4", "vbd, 5 iterations"
  std::vector<TradeStep> steps;  // falling
  bool open_ended = false;       // a ladder that goes as far as the budget does
};

// What a user would type, below the options of all.
struct TradeSetting {
  std::size_t group = 0;
  TradeStep step;
  std::vector<std::string> overrides;  // PATH=VALUE
  std::string label;                   // all of them
};

// `base`: the scene with the options' overrides. Errors: what the loader refuses.
Result<std::vector<TradeGroup>> make_trade_groups(const TradeOptions& options, const Scene& base,
                                                  const std::vector<TradeMesh>& meshes);

TradeSetting make_setting(const std::vector<TradeGroup>& groups, std::size_t group, const TradeStep& step,
                          const std::vector<TradeMesh>& meshes, double frame);

// h rounded so that a whole number fits a frame, or a frame fits it a whole number of times.
TradeStep round_step(double h, double frame);

// The number of frames that all of the listed steps divide, once rounded.
std::int64_t calc_common_frames(const std::vector<double>& steps, double frame);

}  // namespace flexcast
