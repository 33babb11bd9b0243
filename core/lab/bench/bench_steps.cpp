#include "core/lab/bench/bench_steps.h"

#include <malloc.h>

#include <chrono>

#include "core/integrators/integrator.h"
#include "core/lab/bench/bench_timing.h"

namespace flexcast {

std::int64_t count_allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

bool StepBench::run(Simulation& simulation, const StepSettings& settings) {
  using Clock = std::chrono::steady_clock;
  double spent = 0.0;
  while (count() < settings.count && (count() < settings.least_count || spent < settings.budget)) {
    if (settings.stop && settings.stop->load(std::memory_order_relaxed)) break;
    const Clock::time_point start = Clock::now();
    if (!simulation.step()) return false;
    seconds_.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    spent += seconds_.back();
    iterations_.push_back(simulation.statistics().iterations);
    linear_iterations_.push_back(simulation.statistics().linear_iterations);
  }
  return true;
}

StepTimes StepBench::calc_times() const {
  return {count(), calc_median(seconds_), calc_median(iterations_), calc_median(linear_iterations_)};
}

std::optional<double> calc_kernel_share(const TimeSettings& time, const StepTimes& steps, const KernelTimes& kernels) {
  const IntegratorRow& row = *find_integrator(time.integrator);
  if (row.name == "xpbd" || row.name == "vbd") return {};
  const double substeps = time.substeps;
  double seconds = substeps * (row.name == "rk4" ? 4.0 : 1.0) * kernels.force;
  if (row.implicit) {
    seconds +=
        steps.iterations * (kernels.tangent + kernels.force) + steps.linear_iterations * kernels.chosen_iteration;
  }
  return seconds / steps.seconds;
}

}  // namespace flexcast
