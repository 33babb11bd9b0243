#include "core/lab/cost/step_turns.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace flexcast {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int untimed_steps = 3;  // the first makes what later ones keep
constexpr int wanted_rounds = 50;

// How the steps are divided.
struct Plan {
  int rounds = 1;
  int block = 1;  // steps of a round
};

// `step_seconds`: of the first; `turn_seconds`: of one step of each.
Plan make_plan(const StepTurnSettings& settings, double step_seconds, double turn_seconds) {
  Plan plan;
  const double wanted = std::ceil(settings.sample / std::max(step_seconds, 1e-9));
  plan.block = static_cast<int>(std::clamp(wanted, 1.0, std::max(1.0, std::floor(settings.steps / wanted_rounds))));
  const double fitting = settings.budget / std::max(turn_seconds * plan.block, 1e-9);
  plan.rounds = static_cast<int>(std::min<double>(settings.steps / plan.block, fitting));
  plan.rounds = std::max(plan.rounds, settings.least_rounds);
  return plan;
}

// s, of `count` steps.
double take_steps(Simulation& simulation, int count, SteppedSimulation& result) {
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < count; ++i) {
    if (!simulation.step()) {
      result.failure = simulation.failure()->text();
      break;
    }
    result.iterations += simulation.statistics().iterations;
    result.linear_iterations += simulation.statistics().linear_iterations;
  }
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool is_stopped(const StepTurnSettings& settings) {
  return settings.stop && settings.stop->load(std::memory_order_relaxed);
}

// Returns the seconds of the last step of each.
std::vector<double> warm_up(const std::vector<std::unique_ptr<Simulation>>& simulations,
                            const StepTurnSettings& settings, SteppedTurns& turns) {
  std::vector<double> seconds(simulations.size(), 0.0);
  for (int step = 0; step < untimed_steps; ++step) {
    for (std::size_t i = 0; i < simulations.size() && !is_stopped(settings); ++i) {
      if (turns.simulations[i].failure.empty()) seconds[i] = take_steps(*simulations[i], 1, turns.simulations[i]);
    }
  }
  for (SteppedSimulation& simulation : turns.simulations) simulation.iterations = simulation.linear_iterations = 0.0;
  return seconds;
}

// One round.
void step_all(const std::vector<std::unique_ptr<Simulation>>& simulations, const StepTurnSettings& settings, int block,
              SteppedTurns& turns) {
  for (std::size_t i = 0; i < simulations.size() && !is_stopped(settings); ++i) {
    SteppedSimulation& result = turns.simulations[i];
    if (!result.failure.empty()) continue;
    const double spent = take_steps(*simulations[i], block, result);
    if (result.failure.empty()) result.seconds.push_back(spent / block);
  }
}

}  // namespace

SteppedTurns step_in_turns(const std::vector<std::unique_ptr<Simulation>>& simulations,
                           const StepTurnSettings& settings) {
  SteppedTurns turns;
  turns.simulations.resize(simulations.size());
  const std::vector<double> seconds = warm_up(simulations, settings, turns);
  double turn_seconds = 0.0;
  for (const double of_one : seconds) turn_seconds += of_one;
  const Plan plan = make_plan(settings, seconds.front(), turn_seconds);
  turns.stopped = is_stopped(settings);
  for (int round = 0; round < plan.rounds && turns.simulations.front().failure.empty() && !turns.stopped; ++round) {
    step_all(simulations, settings, plan.block, turns);
    turns.stopped = is_stopped(settings);
    if (!turns.stopped) turns.steps += plan.block;
    if (settings.progress) settings.progress(round + 1, plan.rounds);
  }
  for (SteppedSimulation& simulation : turns.simulations) {
    simulation.iterations /= std::max(1, turns.steps);
    simulation.linear_iterations /= std::max(1, turns.steps);
  }
  return turns;
}

}  // namespace flexcast
