// The verb `trade`: accuracy against time, measured.
#pragma once

#include <iosfwd>

#include "core/lab/trade/trade_front.h"
#include "core/lab/trade/trade_options.h"
#include "core/lab/trade/trade_order.h"

namespace flexcast {

struct Trade {
  std::string scene;
  int threads = 1;
  double budget = 0.0, spent = 0.0;  // s
  bool stopped = false;              // before its end, by the user
  TradeTimes times;
  TradeMeshes meshes;
  double size = 0.0;         // m, diagonal of the box around all rest positions
  double motion = 0.0;       // m, largest RMS displacement of the reference from its start
  bool has_volumes = false;  // there are tetrahedra
  TradeReference reference;  // without its frames
  std::vector<TradeGroup> groups;
  std::vector<TradeResult> results;                  // in the order of the groups, steps falling
  std::vector<std::optional<ObservedOrder>> orders;  // one a group
  std::vector<TradeLevel> levels;
  std::vector<std::string> notes;  // what a reader should know

  double own_error() const { return motion > 0.0 ? reference.error / motion : 0.0; }  // over the motion's size
};

// Errors: a scene that cannot be loaded or is not what `exact` says, a budget that nothing fits into.
Result<Trade> trade_scene(const TradeOptions& options, TradeClock& clock, std::ostream& log);

// The program's verb; returns the exit code.
int trade_verb(const TradeOptions& options, std::ostream& out, std::ostream& log);

}  // namespace flexcast
