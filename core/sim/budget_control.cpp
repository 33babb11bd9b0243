#include "core/sim/budget_control.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/integrators/integrator.h"
#include "core/sim/simulation.h"

namespace flexcast {
namespace {

constexpr double margin = 0.97;           // of the budget
constexpr double stability_share = 0.95;  // of the stable step
constexpr double dear = 0.98;             // quantile of the costs that is reckoned with
constexpr std::size_t first_samples = 8;  // before anything is chosen
constexpr std::size_t patience = 32;      // steps between two choices of more
constexpr double worthwhile = 1.1;        // so many times the substeps, or none more
constexpr double most_substeps = 1e6;

// How many iterations an integrator step does now, and how many the settings ask for.
struct Iterations {
  int now = 0, configured = 0;
};

Iterations find_iterations(const Simulation& simulation) {
  const Settings& settings = simulation.settings();
  const IntegratorRow& row = *find_integrator(settings.time.integrator);
  if (!row.implicit) return {};
  const TimeChoice& choice = simulation.choice();
  const bool sweeps = row.order == 0;
  const int configured = sweeps ? settings.solver.iterations : settings.solver.newton_iterations;
  if (choice.iterations > 0) return {choice.iterations, configured};
  return {sweeps ? configured : std::max(1, simulation.statistics().iterations / choice.substeps), configured};
}

}  // namespace

double BudgetControl::calc_dear_cost() const {
  std::array<double, window> sorted = costs_;
  const std::size_t count = std::min(count_, window);
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
  return sorted[std::min(count - 1, static_cast<std::size_t>(dear * static_cast<double>(count)))];
}

int BudgetControl::find_least_substeps(const Simulation& simulation) {
  const double limit = simulation.calc_stable_step();
  if (!(std::isfinite(limit) && limit > 0.0)) return 1;
  const double least = std::ceil(simulation.settings().time.step / (stability_share * limit));
  return static_cast<int>(std::min(least, most_substeps));
}

TimeChoice BudgetControl::follow(const Simulation& simulation, double seconds) {
  const TimeSettings& time = simulation.settings().time;
  TimeChoice choice = simulation.choice();
  if (time.budget == 0.0 || time.integrator == "quasi_static") {
    begin();
    return choice;
  }
  costs_[next_] = seconds / choice.substeps;
  next_ = (next_ + 1) % window;
  ++count_;
  ++since_change_;
  const int least = find_least_substeps(simulation);
  if (count_ < first_samples) {
    choice.substeps = std::max(choice.substeps, least);
    return choice;
  }
  const double allowed = time.budget * time.step, cost = calc_dear_cost();
  const double fitting = std::clamp(std::floor(margin * allowed / cost), 0.0, most_substeps);
  const Iterations iterations = find_iterations(simulation);
  if (fitting < least) {
    // What is needed for stability stays; iterations are what can be saved.
    const double share = fitting > 0.0 ? fitting / least : margin * allowed / (cost * least);
    const int fewer = std::max(1, static_cast<int>(share * iterations.now));
    const TimeChoice cheapest{least, iterations.configured > 1 ? fewer : 0};
    if (warning_.empty() && (cheapest == choice || iterations.now <= 1)) {
      char text[200];
      std::snprintf(text, sizeof text,
                    "time.budget = %.3g cannot be kept: a step takes about %.3g ms of the %.3g ms allowed, with the "
                    "least that is possible, %d substeps",
                    time.budget, 1e3 * cost * least, 1e3 * allowed, least);
      warning_ = text;
    }
    if (!(cheapest == choice) && since_change_ >= first_samples) choice = cheapest;
  } else if (fitting >= least) {
    warning_.clear();
  }
  if (fitting >= least && choice.iterations > 0 &&
      fitting > worthwhile * least * (iterations.now + 1.0) / iterations.now) {
    if (since_change_ >= patience)
      choice.iterations = choice.iterations + 1 < iterations.configured ? choice.iterations + 1 : 0;
  } else if (fitting >= least && choice.iterations == 0) {
    const bool first = count_ == first_samples;
    if (fitting < choice.substeps || first || (fitting >= worthwhile * choice.substeps && since_change_ >= patience)) {
      choice.substeps = static_cast<int>(fitting);
    }
  }
  if (!(choice == simulation.choice())) {
    since_change_ = 0;
    if (choice.iterations != simulation.choice().iterations) count_ = next_ = 0;
  }
  return choice;
}

}  // namespace flexcast
