#include "core/lab/stream/stream_trade.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <ostream>

#include "core/base/parallel.h"
#include "core/lab/bench/bench_timing.h"
#include "core/lab/output_file.h"
#include "core/lab/progress.h"
#include "core/lab/run_length.h"
#include "core/lab/stream/frame_preparation.h"
#include "core/lab/stream/stream_errors.h"
#include "core/lab/stream/stream_trade_report.h"
#include "core/scene/scene.h"
#include "core/sim/frame_size.h"

namespace flexcast {
namespace {

const std::vector<int> everies = {1, 2, 10};

using FieldList = std::vector<std::string>;

// Positions alone, with velocities, and everything there is.
std::vector<FieldList> list_fields(const Model& model) {
  FieldList all = {"positions", "velocities", "stretch"};
  if (!model.tetrahedra.empty()) all.emplace_back("stress");
  return {{"positions"}, {"positions", "velocities"}, all};
}

// s, of each format, medians of repeats that take turns.
std::vector<double> measure_preparations(const Simulation& simulation, const std::vector<StreamFormat>& formats) {
  std::vector<FramePreparation> preparations;
  for (const StreamFormat& format : formats) preparations.emplace_back(simulation, format);
  Turns turns;
  std::uint64_t hash = 0;
  for (FramePreparation& preparation : preparations) {
    turns.add([&] {
      hash = simulation.calc_state_hash();
      preparation.run();
    });
  }
  return turns.measure({.turns = 31, .budget = 3.0});
}

double calc_size(const Model& model) {
  const Eigen::Map<const Eigen::Matrix3Xd> rest(model.rest_positions.data(), 3, model.particle_count());
  return (rest.rowwise().maxCoeff() - rest.rowwise().minCoeff()).norm();
}

// Every state of the run to `errors`.
Result<void> run_to_end(Simulation& simulation, std::int64_t count, const StreamTradeOptions& options,
                        std::ostream& log, StreamErrors& errors) {
  using Clock = std::chrono::steady_clock;
  Progress progress(log, options.progress);
  const Clock::time_point start = Clock::now();
  errors.add(simulation.state().positions);
  for (std::int64_t step = 1; step <= count; ++step) {
    if (!simulation.step()) return Error{simulation.failure()->text()};
    errors.add(simulation.state().positions);
    progress.show(step, count, simulation.state().time, std::chrono::duration<double>(Clock::now() - start).count());
    if (options.stop && options.stop->load(std::memory_order_relaxed))
      return Error{"stopped after step " + std::to_string(step) + " of " + std::to_string(count)};
  }
  return {};
}

std::vector<StreamTradeRow> make_rows(const Simulation& simulation, const StreamErrors& errors,
                                      const StreamTrade& trade) {
  std::vector<StreamTradeRow> rows;
  std::vector<StreamFormat> formats;
  for (const StreamPrecisionRow& precision : stream_precisions) {
    for (const FieldList& fields : list_fields(simulation.model())) {
      rows.push_back({.precision = std::string(precision.name), .fields = fields});
      formats.push_back(make_stream_format({.fields = fields, .precision = rows.back().precision}));
    }
  }
  const std::vector<double> seconds = measure_preparations(simulation, formats);
  std::vector<StreamTradeRow> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const int every : everies) {
      StreamTradeRow row = rows[i];
      row.every = every;
      row.frame_bytes = calc_wire_bytes(trade.particles, formats[i], trade.scene.size());
      row.bytes_per_second =
          static_cast<double>(row.frame_bytes) / (static_cast<double>(every) * simulation.settings().time.step);
      row.error = errors.calc_largest(formats[i].precision, every);
      row.relative_error = trade.size > 0.0 ? row.error / trade.size : std::numeric_limits<double>::quiet_NaN();
      row.prepare_seconds = seconds[i];
      all.push_back(std::move(row));
    }
  }
  return all;
}

Result<void> write_files(const StreamTrade& trade, const std::filesystem::path& directory) {
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  if (failure) return Error{directory.string() + ": cannot be made: " + failure.message()};
  const std::pair<const char*, std::string> files[] = {{"stream.csv", make_stream_trade_csv(trade)},
                                                       {"stream.json", make_stream_trade_json(trade).dump(2) + "\n"}};
  for (const auto& [name, text] : files) {
    auto file = OutputFile::open(directory / name);
    if (!file) return file.error();
    file.value().stream() << text;
    if (auto closed = file.value().close(); !closed) return closed.error();
  }
  return {};
}

}  // namespace

Result<StreamTrade> trade_stream(const StreamTradeOptions& options, std::ostream& log) {
  auto loaded = load_scene(options.scene, options.overrides);
  if (!loaded) return loaded.error();
  for (const std::string& note : loaded.value().notes) log << "flexcast-lab: warning: " << note << std::endl;
  Simulation& simulation = *loaded.value().simulation;
  const auto count = calc_run_length(options.until, simulation.settings().time);
  if (!count) return count.error();

  StreamErrors errors(everies);
  if (auto done = run_to_end(simulation, count.value(), options, log, errors); !done) return done.error();
  StreamTrade trade;
  trade.scene = loaded.value().name;
  trade.integrator = simulation.settings().time.integrator;
  trade.particles = simulation.model().particle_count();
  trade.steps = count.value();
  trade.time = simulation.state().time;
  trade.size = calc_size(simulation.model());
  trade.rows = make_rows(simulation, errors, trade);
  return trade;
}

const StreamTradeRow* find_cheapest(const StreamTrade& trade, double relative_error) {
  const StreamTradeRow* cheapest = nullptr;
  for (const StreamTradeRow& row : trade.rows) {
    if (!(row.relative_error <= relative_error)) continue;
    if (!cheapest || row.bytes_per_second < cheapest->bytes_per_second) cheapest = &row;
  }
  return cheapest;
}

int stream_trade_verb(const StreamTradeOptions& options, std::ostream& out, std::ostream& log) {
  set_thread_count(options.threads);
  const auto trade = trade_stream(options, log);
  if (!trade) {
    log << "flexcast-lab: " << trade.error().message << std::endl;
    return 1;
  }
  if (options.json) {
    out << make_stream_trade_json(trade.value()).dump(2) << std::endl;
  } else {
    out << make_stream_trade_text(trade.value()) << std::flush;
  }
  if (options.directory) {
    if (auto written = write_files(trade.value(), *options.directory); !written) {
      log << "flexcast-lab: " << written.error().message << std::endl;
      return 1;
    }
  }
  if (!out) log << "flexcast-lab: the table cannot be written" << std::endl;
  return out ? 0 : 1;
}

}  // namespace flexcast
