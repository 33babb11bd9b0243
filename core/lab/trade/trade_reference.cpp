#include "core/lab/trade/trade_reference.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/integrators/integrator.h"
#include "core/lab/trade/trade_exact.h"
#include "core/lab/trade/trade_volume.h"

namespace flexcast {
namespace {

constexpr double least_order = 0.5;
constexpr double agreement = 3e-4;  // of the motion: a third of the least level

// A scheme for a reference and the number of its steps a frame to begin with.
struct Candidate {
  const IntegratorRow* row = nullptr;
  std::int64_t substeps = 1;
  double step_seconds = 0.0;  // wall time of one

  std::vector<std::string> make_overrides(const TradeMesh& mesh) const {
    std::vector<std::string> overrides = mesh.overrides;
    overrides.push_back("time.integrator=" + std::string(row->name));
    overrides.push_back("time.substeps=" + std::to_string(substeps));
    if (row->implicit) {
      for (const char* tight :
           {"solver.newton_tolerance=1e-12", "solver.newton_iterations=50", "solver.linear_tolerance=1e-10"})
        overrides.emplace_back(tight);
    }
    return overrides;
  }
};

std::vector<const char*> list_schemes(const Model& model) {
  if (model.obstacles.empty()) return {"rk4", "velocity_verlet", "bdf2"};
  return {"bdf2", "velocity_verlet", "backward_euler"};
}

Result<Candidate> make_candidate(const char* name, const TradeRunner& runner, double share) {
  const TradeMesh& mesh = runner.meshes().all[runner.meshes().finest];
  const double frame = runner.times().frame;
  Candidate candidate{find_integrator(name), 1, 0.0};
  const auto loaded = runner.load(candidate.make_overrides(mesh));
  if (!loaded) return loaded.error();
  const double limit = loaded.value()->calc_stable_step();
  candidate.substeps = static_cast<std::int64_t>(std::clamp(std::ceil(frame / limit), 1.0, 1e6));
  if (frame / limit > 1e6) candidate.step_seconds = share;  // no number of steps is enough
  const double h = frame / static_cast<double>(candidate.substeps);
  const auto seconds = runner.probe(candidate.make_overrides(mesh), h, share);
  if (!seconds) return seconds.error();
  candidate.step_seconds = std::max(candidate.step_seconds, seconds.value());
  return candidate;
}

double predict_seconds(const Candidate& candidate, const TradeTimes& times) {
  return candidate.step_seconds * static_cast<double>(candidate.substeps) * static_cast<double>(times.frames());
}

Error make_too_long(const TradeRunner& runner, double seconds, double share) {
  char text[400];
  if (share <= 0.0) {
    std::snprintf(text, sizeof text,
                  "nothing fits into the budget of %g s: loading the scene and a first step have taken %.3g s; raise "
                  "--budget",
                  runner.budget().seconds(), runner.budget().spent());
    return {text};
  }
  std::snprintf(text, sizeof text,
                "nothing fits into the budget of %g s: two runs of the cheapest reference take about %.3g s, of which "
                "%.3g s are left for them; raise --budget or shorten --until (now %g s)",
                runner.budget().seconds(), seconds, share, runner.times().duration());
  return {text};
}

// The first of whose runs three fit, else two: one step, half of it, a quarter.
Result<Candidate> choose_candidate(const TradeRunner& runner, double share) {
  const TradeMesh& mesh = runner.meshes().all[runner.meshes().finest];
  const auto loaded = runner.load(mesh.overrides);
  if (!loaded) return loaded.error();
  std::vector<Candidate> candidates;
  double least = std::numeric_limits<double>::infinity();
  for (const char* name : list_schemes(loaded.value()->model())) {
    if (share <= 0.0) break;
    const double begun = runner.budget().spent();
    auto candidate = make_candidate(name, runner, share);
    if (!candidate) return candidate.error();
    share -= runner.budget().spent() - begun;
    const double seconds = predict_seconds(candidate.value(), runner.times());
    if (7.0 * seconds <= share) return candidate;
    least = std::min(least, 3.0 * seconds);
    candidates.push_back(candidate.value());
  }
  for (const Candidate& candidate : candidates) {
    if (3.0 * predict_seconds(candidate, runner.times()) <= share) return candidate;
  }
  return make_too_long(runner, least, std::max(share, 0.0));
}

class Halving {
 public:
  Halving(const TradeRunner& runner, const ReferenceSettings& settings, const Candidate& candidate)
      : runner_(runner), settings_(settings), candidate_(candidate), begun_(runner.budget().spent()) {}

  Result<TradeReference> run() {
    for (;;) {
      const double left = settings_.share - (runner_.budget().spent() - begun_);
      auto run = run_level(left);
      if (!run) return run.error();
      if (runner_.budget().is_stopped()) return Error{"stopped before there was a reference"};
      if (run.value().end == TradeRun::End::failed) {
        if (!restart()) return Error{"the reference fails: " + run.value().cause};
      } else if (run.value().end == TradeRun::End::cut) {
        if (reference_.levels.size() >= 2) break;
        return make_too_long(runner_, 3.0 * predict_seconds(candidate_, runner_.times()), settings_.share);
      } else {
        add_level(run.value());
        if (is_enough(2.0 * run.value().seconds)) break;
      }
      candidate_.substeps *= 2;
    }
    return std::move(reference_);
  }

 private:
  Result<TradeRun> run_level(double left) {
    overrides_ = candidate_.make_overrides(runner_.meshes().all[runner_.meshes().finest]);
    char text[120];
    std::snprintf(text, sizeof text, "reference: %s with %lld steps a frame", std::string(candidate_.row->name).c_str(),
                  static_cast<long long>(candidate_.substeps));
    if (settings_.show) settings_.show(text);
    return runner_.record(overrides_, runner_.meshes().finest, std::max(left, 0.0), frames_);
  }

  // From half the step on.
  bool restart() {
    reference_ = {};
    return ++failures_ < 8;
  }

  void add_level(const TradeRun& run) {
    ReferenceLevel level{runner_.times().frame / static_cast<double>(candidate_.substeps), run.seconds, {}};
    if (!reference_.levels.empty()) {
      level.difference = calc_distance(frames_, reference_.frames);
      const std::optional<double> before = reference_.levels.back().difference;
      const double floor = 1e-15 * settings_.size;
      reference_.error = std::max(calc_own_error(*level.difference, before, candidate_.row->order), floor);
      reference_.agreed_until =
          calc_agreed_until(frames_, reference_.frames, runner_.times(), agreement * calc_motion(frames_));
      if (before && *level.difference > 0.0) reference_.order = std::log2(*before / *level.difference);
    }
    reference_.levels.push_back(level);
    reference_.frames = std::move(frames_);
    reference_.overrides = overrides_;
    reference_.label.clear();
    for (const std::string& text : overrides_) reference_.label += (reference_.label.empty() ? "" : " ") + text;
  }

  bool is_enough(double next_seconds) const {
    if (reference_.levels.size() < 2) return false;
    const double left = settings_.share - (runner_.budget().spent() - begun_);
    if (next_seconds > left || candidate_.substeps > 500'000) return true;
    // Without an order as fine a run as the share allows is all there is, but rounding is never beaten.
    const bool lost = reference_.order && *reference_.order < least_order;
    if (lost && reference_.error < 1e-9 * settings_.size) return true;
    const bool cheap = next_seconds < 0.05 * settings_.share;
    return reference_.error <= (cheap ? 1e-12 : 1e-5) * settings_.size && reference_.levels.size() >= 3;
  }

  const TradeRunner& runner_;
  const ReferenceSettings& settings_;
  Candidate candidate_;
  double begun_;
  int failures_ = 0;
  std::vector<std::string> overrides_;
  TradeFrames frames_;
  TradeReference reference_;
};

}  // namespace

double calc_agreed_until(const TradeFrames& a, const TradeFrames& b, const TradeTimes& times, double distance) {
  double until = 0.0;
  for (std::size_t i = 0; i < a.at.size(); ++i) {
    if (calc_rms(a.at[i].positions - b.at[i].positions) > distance) break;
    until = static_cast<double>(times.compared[i]) * times.frame;
  }
  return until;
}

double calc_own_error(double difference, std::optional<double> before, int order) {
  // One pair shows no order: the least that a scheme can have is assumed.
  if (!before || difference == 0.0) return difference;
  const double observed = std::log2(*before / difference);
  return difference / (std::exp2(std::clamp(observed, least_order, static_cast<double>(order))) - 1.0);
}

Result<TradeReference> make_exact_reference(const std::string& name, const TradeRunner& runner) {
  const std::size_t finest = runner.meshes().finest;
  const auto loaded = runner.load(runner.meshes().all[finest].overrides);
  if (!loaded) return loaded.error();
  const Simulation& simulation = *loaded.value();
  auto solution = find_exact(name)->make(simulation);
  if (!solution) return solution.error();
  TradeReference reference;
  reference.exact = name;
  reference.label = std::string(find_exact(name)->summary);
  reference.frames.start = runner.make_frame(simulation, finest);
  const std::vector<std::int64_t>& compared = runner.meshes().all[finest].compared;
  for (const std::int64_t frame : runner.times().compared) {
    const VecX all = solution.value()->calc_positions(static_cast<double>(frame) * runner.times().frame);
    TradeFrame at{VecX(3 * static_cast<Eigen::Index>(compared.size())), calc_volumes(simulation.model(), all)};
    for (std::size_t i = 0; i < compared.size(); ++i)
      block3(at.positions, static_cast<std::int64_t>(i)) = block3(all, compared[i]);
    reference.frames.at.push_back(std::move(at));
  }
  return reference;
}

Result<TradeReference> make_converged_reference(const TradeRunner& runner, const ReferenceSettings& settings) {
  const double begun = runner.budget().spent();
  const auto candidate = choose_candidate(runner, settings.share);
  if (!candidate) return candidate.error();
  ReferenceSettings rest = settings;
  rest.share -= runner.budget().spent() - begun;
  return Halving(runner, rest, candidate.value()).run();
}

}  // namespace flexcast
