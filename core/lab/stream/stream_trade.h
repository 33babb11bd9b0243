// The verb `trade --stream`: what the stream of a scene costs in each of its formats, and what a viewer loses by it.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/sim/stream_format.h"

namespace flexcast {

struct StreamTradeOptions {
  std::filesystem::path scene;
  std::optional<double> until;  // s; without it the scene's duration, or 1000 steps
  std::vector<std::string> overrides;
  std::optional<std::filesystem::path> directory;  // for stream.csv and stream.json
  int threads = 1;                                 // of the engine
  bool json = false;
  bool progress = false;                    // on the log while running
  const std::atomic<bool>* stop = nullptr;  // ends the run early when it becomes true
};

// One format.
struct StreamTradeRow {
  std::string precision;            // as in scene files
  std::vector<std::string> fields;  // likewise
  int every = 1;
  std::size_t frame_bytes = 0;    // on the wire, all samples of a frame, for a world called like the scene
  double bytes_per_second = 0.0;  // of simulated time
  double error = 0.0;             // m, see stream_errors.h
  double relative_error = 0.0;    // of the scene's size; not finite: it has none
  double prepare_seconds = 0.0;   // a frame: fields, hash, bounds and conversion; neither copies nor DDS's own write
};

struct StreamTrade {
  std::string scene, integrator;
  std::int64_t particles = 0, steps = 0;
  double time = 0.0;  // s, simulated
  double size = 0.0;  // m, diagonal of the box around the rest positions
  std::vector<StreamTradeRow> rows;
};

// Runs the scene once and looks at all formats. Errors: a scene that cannot be loaded, that fails or is stopped.
Result<StreamTrade> trade_stream(const StreamTradeOptions& options, std::ostream& log);

// The row with the least bytes a second among those within the error, always one of positions alone; null: there is
// none.
const StreamTradeRow* find_cheapest(const StreamTrade& trade, double relative_error);

// The program's verb; returns the exit code.
int stream_trade_verb(const StreamTradeOptions& options, std::ostream& out, std::ostream& log);

}  // namespace flexcast
