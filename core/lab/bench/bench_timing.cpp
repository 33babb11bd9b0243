#include "core/lab/bench/bench_timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/checks.h"

namespace flexcast {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// s, of one of `repeats` runs.
double time_runs(const std::function<void()>& run, int repeats) {
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < repeats; ++i) run();
  return seconds_since(start) / repeats;
}

int count_repeats(const std::function<void()>& run, double sample) {
  int repeats = 1;
  for (double seconds = time_runs(run, 1); seconds * repeats < sample && repeats < 1'000'000;) {
    repeats = std::clamp(static_cast<int>(std::ceil(sample / std::max(seconds, 1e-9))), 2 * repeats, 1'000'000);
    seconds = time_runs(run, repeats);
  }
  return repeats;
}

}  // namespace

double calc_median(std::vector<double> values) {
  FLEXCAST_CHECK(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void Turns::add(std::function<void()> task, std::function<void()> prepare) {
  tasks_.push_back({std::move(task), std::move(prepare)});
}

std::vector<double> Turns::measure(const TurnSettings& settings) const {
  std::vector<int> repeats;
  for (const Task& task : tasks_) {
    if (task.prepare) task.prepare();
    task.run();  // touches its memory for the first time
    repeats.push_back(count_repeats(task.run, settings.sample));
  }
  std::vector<std::vector<double>> samples(tasks_.size());
  const Clock::time_point start = Clock::now();
  for (int turn = 0; turn < settings.turns; ++turn) {
    if (turn >= settings.least_turns && seconds_since(start) > settings.budget) break;
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
      if (tasks_[i].prepare) tasks_[i].prepare();
      samples[i].push_back(time_runs(tasks_[i].run, repeats[i]));
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& of_task : samples) medians.push_back(calc_median(std::move(of_task)));
  return medians;
}

}  // namespace flexcast
