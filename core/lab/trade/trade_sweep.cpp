#include "core/lab/trade/trade_sweep.h"

#include <algorithm>
#include <cstdio>

#include "core/lab/bench/bench_timing.h"

namespace flexcast {
namespace {

using Status = TradeResult::Status;

// What is known of a group while its steps are taken from coarse to fine.
struct GroupState {
  bool open = true;
  std::optional<double> step_seconds;  // wall time of an integrator step
  int done = 0, stagnant = 0;
  double last_error = 0.0;
};

class Sweep {
 public:
  Sweep(const TradeRunner& runner, const std::vector<TradeGroup>& groups, const SweepSettings& settings)
      : runner_(runner),
        groups_(groups),
        settings_(settings),
        states_(groups.size()),
        first_end_(runner.budget().spent() + 0.6 * runner.budget().left()) {}

  Result<std::vector<TradeResult>> run() {
    std::size_t longest = 0;
    for (const TradeGroup& group : groups_) longest = std::max(longest, group.steps.size());
    for (std::size_t rung = 0; rung < longest; ++rung) {
      for (std::size_t g = 0; g < groups_.size() && !runner_.budget().is_stopped(); ++g) {
        if (rung >= groups_[g].steps.size() || !states_[g].open) continue;
        if (auto taken = take(g, groups_[g].steps[rung]); !taken) return taken.error();
      }
    }
    if (auto repeated = repeat(); !repeated) return repeated.error();
    for (TradeResult& result : results_) {
      if (!result.samples.empty()) result.cost = calc_median(result.samples) / runner_.times().duration();
    }
    std::ranges::stable_sort(results_, {}, [](const TradeResult& result) { return result.setting.group; });
    return std::move(results_);
  }

 private:
  double count_steps(const TradeSetting& setting) const {
    return static_cast<double>(runner_.times().frames() / setting.step.frames) * setting.step.substeps;
  }

  // s a single run may be predicted to take.
  double calc_allowance() const {
    return std::min(first_end_ - runner_.budget().spent(), 0.25 * runner_.budget().seconds());
  }

  Result<void> predict(const TradeGroup& group, TradeResult& result) {
    GroupState& state = states_[result.setting.group];
    if (!state.step_seconds) {
      const auto h = group.tolerance ? std::nullopt : std::optional(result.h);
      const auto seconds = runner_.probe(result.setting.overrides, h, std::max(calc_allowance(), 0.0));
      if (!seconds) return seconds.error();
      state.step_seconds = seconds.value();
    }
    result.predicted = count_steps(result.setting) * *state.step_seconds;
    return {};
  }

  Result<void> take(std::size_t g, const TradeStep& step) {
    const TradeGroup& group = groups_[g];
    TradeResult result;
    result.setting = make_setting(groups_, g, step, runner_.meshes().all, runner_.times().frame);
    result.h = group.tolerance ? 0.0 : step.calc_seconds(runner_.times().frame);
    if (settings_.show) settings_.show(result.setting.label);
    const bool any_left = calc_allowance() > 0.0;
    if (any_left) {
      if (auto predicted = predict(group, result); !predicted) return predicted;
    }
    if (!any_left || result.predicted > calc_allowance()) {
      skip(group, result);
    } else if (auto measured = measure(result); !measured) {
      return measured;
    }
    follow(group, result);
    results_.push_back(std::move(result));
    return {};
  }

  void skip(const TradeGroup& group, TradeResult& result) {
    char text[160];
    std::snprintf(text, sizeof text, "skipped: about %.2g s a run do not fit the budget", result.predicted);
    result.cause = result.predicted > 0.0 ? text : "skipped: the budget was used up";
    // Finer ones would take longer still; the first says so for all.
    if (group.open_ended) states_[result.setting.group].open = false;
  }

  Result<void> measure(TradeResult& result) {
    // A machine that does something else meanwhile is no reason to give up.
    const double most =
        std::clamp(10.0 * result.predicted, std::min(1.0, calc_allowance()), std::max(calc_allowance(), 1e-3));
    const std::size_t mesh = groups_[result.setting.group].mesh;
    const auto run = runner_.compare(result.setting.overrides, mesh, most, settings_.reference->frames, result.errors);
    if (!run) return run.error();
    result.time = run.value().time;
    result.status = run.value().end == TradeRun::End::done     ? Status::done
                    : run.value().end == TradeRun::End::failed ? Status::failed
                                                               : Status::cut;
    char text[80];
    if (result.status == Status::failed) {
      std::snprintf(text, sizeof text, "failed at t = %.4g s: ", result.time);
      result.cause = text + run.value().cause;
    } else if (result.status == Status::cut) {
      std::snprintf(text, sizeof text, "cut off at t = %.4g s after %.2g s", result.time, run.value().seconds);
      result.cause = text;
    } else {
      finish(run.value().seconds, result);
    }
    return {};
  }

  void finish(double seconds, TradeResult& result) {
    result.samples.push_back(seconds);
    result.error = settings_.motion > 0.0 ? result.errors.rms / settings_.motion : 0.0;
    result.at_limit = result.errors.rms < 3.0 * settings_.reference->error;
    states_[result.setting.group].step_seconds = seconds / count_steps(result.setting);
  }

  // Ends a ladder that has nothing more to say.
  void follow(const TradeGroup& group, const TradeResult& result) {
    GroupState& state = states_[result.setting.group];
    if (!group.open_ended || result.status != Status::done || result.setting.step.above_limit) return;
    ++state.done;
    const bool same = state.done > 1 && result.error > 0.9 * state.last_error && result.error < 0.2;
    state.stagnant = same ? state.stagnant + 1 : 0;
    state.last_error = result.error;
    if (result.at_limit || state.stagnant >= 2 || (result.error < 1e-6 && state.done >= 4)) state.open = false;
  }

  int choose_repeats(const TradeResult& result) const {
    if (settings_.repeats) return *settings_.repeats;
    return result.samples.front() < 1.0 ? 7 : 1;
  }

  // Rounds over all settings, so that a drift of the machine falls on all of them alike.
  Result<void> repeat() {
    for (int round = 2; round <= settings_.repeats.value_or(7); ++round) {
      for (TradeResult& result : results_) {
        if (result.status != Status::done || choose_repeats(result) < round) continue;
        if (runner_.budget().is_stopped() || 1.2 * result.samples.front() > runner_.budget().left()) continue;
        if (settings_.show) settings_.show("again: " + result.setting.label);
        const auto run = runner_.time(result.setting.overrides, std::max(runner_.budget().left(), 0.0));
        if (!run) return run.error();
        if (run.value().end == TradeRun::End::done) result.samples.push_back(run.value().seconds);
      }
    }
    return {};
  }

  const TradeRunner& runner_;
  const std::vector<TradeGroup>& groups_;
  const SweepSettings& settings_;
  std::vector<GroupState> states_;
  double first_end_;  // s of the budget at which the first runs end
  std::vector<TradeResult> results_;
};

}  // namespace

const char* name_status(Status status) {
  switch (status) {
    case Status::done:
      return "done";
    case Status::failed:
      return "failed";
    case Status::skipped:
      return "skipped";
    case Status::cut:
      break;
  }
  return "cut";
}

Result<std::vector<TradeResult>> run_sweep(const TradeRunner& runner, const std::vector<TradeGroup>& groups,
                                           const SweepSettings& settings) {
  return Sweep(runner, groups, settings).run();
}

}  // namespace flexcast
