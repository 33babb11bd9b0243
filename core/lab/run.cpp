#include "core/lab/run.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "core/base/parallel.h"
#include "core/lab/frame_table.h"
#include "core/lab/output_file.h"
#include "core/lab/progress.h"
#include "core/lab/report_json.h"
#include "core/lab/report_text.h"
#include "core/lab/run_length.h"
#include "core/lab/statics.h"
#include "core/sim/budget_control.h"

namespace flexcast {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

bool is_stopped(const RunOptions& options) {
  return options.stop && options.stop->load(std::memory_order_relaxed);
}

// Steps to the end, a frame to the table at the start and every stream.every steps.
void step_to_end(const RunOptions& options, std::int64_t count, Run& run, FrameTable* table, Progress& progress) {
  Simulation& simulation = *run.scene.simulation;
  BudgetControl budget;
  if (table) table->add(simulation);
  run.state = "finished";
  while (run.steps < count && run.state == "finished") {
    const Clock::time_point start = Clock::now();
    const bool done = simulation.step();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    run.wall_seconds += seconds;
    if (!done) {
      run.state = "failed";
      break;
    }
    ++run.steps;
    run.substeps += simulation.statistics().substeps;
    simulation.choose(budget.follow(simulation, seconds));
    if (table && run.steps % simulation.settings().stream.every == 0) table->add(simulation);
    progress.show(run.steps, count, simulation.state().time, run.wall_seconds);
    if (is_stopped(options)) run.state = "stopped";
  }
}

// The equilibrium as a run: its frames are the start and the end.
void go_to_equilibrium(const RunOptions& options, Run& run, FrameTable* table, std::ostream& log) {
  Simulation& simulation = *run.scene.simulation;
  if (table) table->add(simulation);
  const Clock::time_point start = Clock::now();
  const bool found = solve_static(simulation, {.stop = options.stop});
  run.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  run.steps = simulation.state().step;
  run.state = found ? "finished" : is_stopped(options) ? "stopped" : "failed";
  if (!found && !simulation.failure()) {
    log << "flexcast-lab: no equilibrium was found in " << run.steps << " steps: residual "
        << exact_text(simulation.statistics().residual) << ", wanted " << exact_text(run.static_tolerance) << std::endl;
  }
  if (table) table->add(simulation);
}

Result<void> write_positions(const std::filesystem::path& path, const VecX& positions) {
  auto file = OutputFile::open(path);
  if (!file) return file.error();
  for (Eigen::Index i = 0; i < positions.size(); i += 3) {
    file.value().stream() << exact_text(positions[i]) << ' ' << exact_text(positions[i + 1]) << ' '
                          << exact_text(positions[i + 2]) << '\n';
  }
  return file.value().close();
}

}  // namespace

Result<Run> run_scene(const RunOptions& options, std::ostream& log) {
  auto loaded = load_scene(options.scene, options.overrides);
  if (!loaded) return loaded.error();
  Run run{std::move(loaded).value(), "", 0, 0, 0.0, 0.0, {}};
  Simulation& simulation = *run.scene.simulation;
  run.static_tolerance = simulation.settings().solver.newton_tolerance;
  const auto count =
      options.steps ? Result<std::int64_t>(*options.steps) : calc_run_length(options.until, simulation.settings().time);
  if (!count) return count.error();
  run.warnings = run.scene.notes;
  for (std::string& warning : simulation.calc_warnings()) run.warnings.push_back(std::move(warning));
  for (const std::string& warning : run.warnings) log << "flexcast-lab: warning: " << warning << std::endl;

  std::optional<OutputFile> csv;
  std::optional<FrameTable> table;
  if (options.csv) {
    auto file = OutputFile::open(*options.csv);
    if (!file) return file.error();
    csv.emplace(std::move(file).value());
    table.emplace(csv->stream(), simulation);
  }
  if (options.at_equilibrium) {
    go_to_equilibrium(options, run, table ? &*table : nullptr, log);
  } else {
    Progress progress(log, options.progress);
    step_to_end(options, count.value(), run, table ? &*table : nullptr, progress);
  }
  if (csv) {
    if (auto closed = csv->close(); !closed) return closed.error();
  }
  if (options.positions) {
    if (auto written = write_positions(*options.positions, simulation.state().positions); !written)
      return written.error();
  }
  return run;
}

int run_verb(const RunOptions& options, std::ostream& out, std::ostream& log) {
  set_thread_count(options.threads);
  const auto run = run_scene(options, log);
  if (!run) {
    log << "flexcast-lab: " << run.error().message << std::endl;
    return 1;
  }
  if (options.json)
    out << make_report_json(run.value()).dump(2, ' ', false, Json::error_handler_t::replace) << std::endl;
  else
    out << make_report_text(run.value()) << std::flush;
  const auto& failure = run.value().scene.simulation->failure();
  if (failure) log << "flexcast-lab: " << failure->text() << std::endl;
  if (!out) log << "flexcast-lab: the report cannot be written" << std::endl;
  return run.value().state == "finished" && out ? 0 : 1;
}

}  // namespace flexcast
