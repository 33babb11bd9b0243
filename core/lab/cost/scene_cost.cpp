#include "core/lab/cost/scene_cost.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <ostream>

#include "core/base/parallel.h"
#include "core/lab/bench/bench_loops.h"
#include "core/lab/bench/bench_timing.h"
#include "core/lab/cost/scene_cost_report.h"
#include "core/lab/cost/scene_extras.h"
#include "core/lab/cost/scene_features.h"
#include "core/lab/cost/step_turns.h"
#include "core/lab/progress.h"
#include "core/scene/scene.h"

namespace flexcast {
namespace {

// The scene, its twin, and one variant a feature.
using Variants = std::vector<std::unique_ptr<Simulation>>;
constexpr std::size_t twin = 1, first_feature = 2;

Result<Variants> make_variants(const SceneDescription& description, const std::vector<SceneFeature>& features,
                               const std::filesystem::path& directory) {
  std::vector<SceneDescription> descriptions(first_feature + features.size(), description);
  for (std::size_t i = 0; i < features.size(); ++i) features[i].leave_out(descriptions[first_feature + i]);
  Variants variants;
  for (const SceneDescription& one : descriptions) {
    auto simulation = make_simulation(one, directory);
    if (!simulation) return simulation.error();
    variants.push_back(std::move(simulation).value());
  }
  return variants;
}

// Three standard errors of the median of the differences, round by round, which a drift of the machine cancels from:
// for normal noise 1.2533 sigma / sqrt(n), sigma by 1.4826 times the median deviation from the median.
// Source: P. J. Rousseeuw, C. Croux, J. Amer. Statist. Assoc. 88 (1993) 1273-1283.
double calc_spread(const std::vector<double>& with, const std::vector<double>& without) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < std::min(with.size(), without.size()); ++i) differences.push_back(with[i] - without[i]);
  const double middle = calc_median(differences);
  for (double& difference : differences) difference = std::abs(difference - middle);
  return 3.0 * 1.2533 * 1.4826 * calc_median(differences) / std::sqrt(static_cast<double>(differences.size()));
}

FeatureCost calc_cost(const std::string& name, const SteppedSimulation& scene, const SteppedSimulation& variant,
                      double noise) {
  FeatureCost cost;
  cost.name = name;
  cost.failure = variant.failure;
  if (!variant.failure.empty()) return cost;
  cost.seconds = calc_median(scene.seconds) - calc_median(variant.seconds);
  cost.spread = std::max(noise, calc_spread(scene.seconds, variant.seconds));
  cost.iterations = variant.iterations;
  cost.linear_iterations = variant.linear_iterations;
  return cost;
}

void describe_scene_itself(const Simulation& simulation, SceneCost& cost) {
  cost.integrator = simulation.settings().time.integrator;
  cost.elements = count_elements(simulation.model());
  cost.particles = simulation.model().particle_count();
}

Result<SteppedTurns> step_variants(const Variants& variants, const SceneCostOptions& options, std::ostream& log) {
  using Clock = std::chrono::steady_clock;
  Progress progress(log, options.progress);
  const Clock::time_point start = Clock::now();
  const auto show = [&](int round, int rounds) {
    progress.show(round, rounds, variants.front()->state().time,
                  std::chrono::duration<double>(Clock::now() - start).count());
  };
  SteppedTurns turns = step_in_turns(
      variants, {.steps = options.steps, .budget = options.budget, .stop = options.stop, .progress = show});
  const SteppedSimulation& scene = turns.simulations.front();
  if (!scene.failure.empty()) return Error{scene.failure};
  if (turns.stopped) return Error{"stopped after " + std::to_string(turns.steps) + " steps of each variant"};
  return turns;
}

}  // namespace

Result<SceneCost> measure_scene_cost(const SceneCostOptions& options, std::ostream& log) {
  auto described = describe_scene(options.scene, options.overrides);
  if (!described) return described.error();
  const SceneDescription& description = described.value();
  const std::vector<SceneFeature> features = list_features(description);
  auto variants = make_variants(description, features, options.scene.parent_path());
  if (!variants) return variants.error();

  auto turns = step_variants(variants.value(), options, log);
  if (!turns) return turns.error();
  const std::vector<SteppedSimulation>& stepped = turns.value().simulations;
  SceneCost cost;
  cost.scene = description.name;
  cost.threads = options.threads;
  describe_scene_itself(*variants.value().front(), cost);
  cost.steps = turns.value().steps;
  cost.step_seconds = calc_median(stepped.front().seconds);
  cost.noise = std::abs(cost.step_seconds - calc_median(stepped[twin].seconds));
  cost.iterations = stepped.front().iterations;
  cost.linear_iterations = stepped.front().linear_iterations;
  for (std::size_t i = 0; i < features.size(); ++i) {
    cost.features.push_back(calc_cost(features[i].name, stepped.front(), stepped[first_feature + i], cost.noise));
  }
  cost.extras = measure_extras(*variants.value().front());
  return cost;
}

int scene_cost_verb(const SceneCostOptions& options, std::ostream& out, std::ostream& log) {
  set_thread_count(options.threads);
  const auto cost = measure_scene_cost(options, log);
  if (!cost) {
    log << "flexcast-lab: " << cost.error().message << std::endl;
    return 1;
  }
  if (options.json) {
    out << make_scene_cost_json(cost.value()).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
        << std::endl;
  } else {
    out << make_scene_cost_text(cost.value()) << std::flush;
  }
  if (!out) log << "flexcast-lab: the figures cannot be written" << std::endl;
  return out ? 0 : 1;
}

}  // namespace flexcast
