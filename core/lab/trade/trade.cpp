#include "core/lab/trade/trade.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

#include "core/base/parallel.h"
#include "core/forces/system.h"
#include "core/lab/trade/trade_files.h"
#include "core/lab/trade/trade_progress.h"
#include "core/lab/trade/trade_report.h"

namespace flexcast {
namespace {

constexpr double reference_share = 0.35;  // of the budget
constexpr double most_bytes = 256e6;      // of the frames of a run

int choose_frame_count(std::size_t particles) {
  return static_cast<int>(std::clamp(most_bytes / (24.0 * static_cast<double>(particles)), 1.0, 200.0));
}

Result<TradeTimes> make_times(const TradeOptions& options, const Scene& base, std::size_t particles) {
  const TimeSettings& time = base.simulation->settings().time;
  const double until = options.until.value_or(time.duration.value_or(1.0));
  return make_trade_times(time.step, until, calc_common_frames(options.steps, time.step),
                          choose_frame_count(particles));
}

// Bodies of springs are not the same thing with other cells.
void note_springs(const TradeOptions& options, const Scene& base, std::vector<std::string>& notes) {
  if (std::ranges::none_of(options.refinements, [](int r) { return r > 0; })) return;
  for (const SceneMesh& mesh : base.meshes) {
    if (!mesh.fem)
      notes.push_back("body \"" + mesh.body +
                      "\" is made of springs: with more cells it is another body, which need not converge");
  }
}

// Halving the step says nothing of the mesh.
void note_meshes(Trade& trade) {
  if (trade.meshes.all.size() < 2) return;
  const TradeMesh& finest = trade.meshes.all[trade.meshes.finest];
  trade.notes.push_back(
      "errors are against the finest mesh (" + finest.name + ", " + std::to_string(finest.particles) +
      " particles), whose own error in space is not in them: what runs on it looks better than it is");
}

void note_motion(Trade& trade) {
  char text[320];
  if (trade.motion == 0.0) {
    trade.notes.emplace_back("nothing moves: errors have no size to be compared with");
  } else if (trade.own_error() > trade_levels.back()) {
    std::snprintf(
        text, sizeof text,
        "the reference's own error is %.2g %% of the motion: what is within three times of it is not told apart; "
        "its two finest runs agree to 0.03 %% until t = %.3g s: shorten --until to that, or raise --budget",
        100.0 * trade.own_error(), trade.reference.agreed_until);
    trade.notes.emplace_back(text);
  }
}

// Times of a program that had to wait for a processor say little.
void note_waiting(double processor, Trade& trade) {
  if (processor > 0.8 * trade.spent) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "the machine was busy with something else: this program had a processor for %.3g of %.3g s, times are "
                "too long by as much",
                processor, trade.spent);
  trade.notes.emplace_back(text);
}

// A scene so large that there is no time for anything once it has been loaded.
Result<void> check_time_left(const TradeBudget& budget) {
  if (budget.left() > 0.0) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "nothing fits into the budget of %g s: loading the scene has taken %.3g s; raise --budget",
                budget.seconds(), budget.spent());
  return Error{text};
}

Result<TradeReference> make_reference(const Scene& base, const TradeRunner& runner, double size,
                                      TradeProgress& progress) {
  if (!base.exact.empty()) return make_exact_reference(base.exact, runner);
  ReferenceSettings settings{reference_share * runner.budget().left(), size, {}};
  settings.show = [&](const std::string& doing) { progress.show(doing); };
  return make_converged_reference(runner, settings);
}

// What a contract may be the loader says, before anything is measured.
Result<void> check_contracts(const TradeOptions& options) {
  for (const double tolerance : options.tolerances) {
    std::vector<std::string> overrides = options.overrides;
    overrides.push_back("time.tolerance=" + to_text(ParameterValue(tolerance)));
    if (const auto scene = load_scene(options.scene, overrides); !scene) return scene.error();
  }
  return {};
}

Result<void> measure(const TradeOptions& options, const Scene& base, const TradeBudget& budget, TradeProgress& progress,
                     Trade& trade) {
  const TradeRunner runner(options, trade.meshes, trade.times, budget);
  auto reference = make_reference(base, runner, trade.size, progress);
  if (!reference) return reference.error();
  trade.reference = std::move(reference).value();
  trade.motion = calc_motion(trade.reference.frames);
  trade.has_volumes = !trade.reference.frames.start.volumes.isZero(0.0);
  auto groups = make_trade_groups(options, base, trade.meshes.all);
  if (!groups) return groups.error();
  trade.groups = std::move(groups).value();
  SweepSettings sweep{&trade.reference, trade.motion, options.repeats, {}};
  sweep.show = [&](const std::string& doing) { progress.show(doing); };
  auto results = run_sweep(runner, trade.groups, sweep);
  if (!results) return results.error();
  trade.results = std::move(results).value();
  trade.reference.frames = {};
  return {};
}

}  // namespace

Result<Trade> trade_scene(const TradeOptions& options, TradeClock& clock, std::ostream& log) {
  const TradeBudget budget(clock, options.budget, options.stop);
  const double processor = clock.processor();
  const auto base = load_scene(options.scene, options.overrides);
  if (!base) return base.error();
  if (auto good = check_contracts(options); !good) return good.error();
  Trade trade;
  trade.scene = base.value().name;
  trade.threads = options.threads;
  trade.budget = options.budget;
  trade.notes = base.value().notes;
  trade.size = System(base.value().simulation->model()).size();
  note_springs(options, base.value(), trade.notes);
  if (auto in_time = check_time_left(budget); !in_time) return in_time.error();
  auto meshes = make_trade_meshes(options, base.value());
  if (!meshes) return meshes.error();
  trade.meshes = std::move(meshes).value();
  if (auto in_time = check_time_left(budget); !in_time) return in_time.error();
  auto times = make_times(options, base.value(), trade.meshes.all.front().compared.size());
  if (!times) return times.error();
  trade.times = std::move(times).value();

  TradeProgress progress(log, options.progress, budget);
  if (auto measured = measure(options, base.value(), budget, progress, trade); !measured) return measured.error();
  mark_front(trade.results);
  for (std::size_t i = 0; i < trade.groups.size(); ++i) trade.orders.push_back(calc_order(trade.results, i));
  trade.levels = find_cheapest(trade.results, trade.own_error());
  note_motion(trade);
  note_meshes(trade);
  trade.spent = budget.spent();
  note_waiting(clock.processor() - processor, trade);
  trade.stopped = budget.is_stopped();
  return trade;
}

int trade_verb(const TradeOptions& options, std::ostream& out, std::ostream& log) {
  set_thread_count(options.threads);
  const auto refuse = [&](const std::string& reason) {
    log << "flexcast-lab: " << reason << std::endl;
    return 1;
  };
  if (auto made = make_folder(options.folder); !made) return refuse(made.error().message);
  const auto trade = trade_scene(options, *make_wall_clock(), log);
  if (!trade) return refuse(trade.error().message);
  for (const std::string& note : trade.value().notes) log << "flexcast-lab: note: " << note << std::endl;
  if (auto written = write_trade_files(trade.value(), options.folder); !written) return refuse(written.error().message);
  if (options.json) {
    out << make_trade_json(trade.value()).dump(2) << std::endl;
  } else {
    out << make_trade_text(trade.value()) << std::flush;
  }
  if (!out) return refuse("the figures cannot be written");
  return trade.value().stopped ? refuse("stopped before the end") : 0;
}

}  // namespace flexcast
