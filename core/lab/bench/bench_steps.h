// What steps of a simulation cost.
#pragma once

#include <atomic>
#include <vector>

#include "core/base/result.h"
#include "core/lab/bench/bench_kernels.h"
#include "core/sim/simulation.h"

namespace flexcast {

struct StepSettings {
  int count = 30;
  int least_count = 3;   // taken whatever they cost
  double budget = 60.0;  // s: no further step begins once this has passed
  const std::atomic<bool>* stop = nullptr;
};

// Medians over the steps taken.
struct StepTimes {
  int count = 0;
  double seconds = 0.0;
  double iterations = 0.0;         // nonlinear
  double linear_iterations = 0.0;  // 0 for direct solvers and explicit schemes
};

// Bytes that the process has allocated and not freed.
std::int64_t count_allocated_bytes();

class StepBench {
 public:
  // Steps until the settings say enough. False: a step failed; what was measured before stays.
  bool run(Simulation& simulation, const StepSettings& settings);
  // Of at least one step.
  StepTimes calc_times() const;
  int count() const { return static_cast<int>(seconds_.size()); }

 private:
  std::vector<double> seconds_, iterations_, linear_iterations_;
};

// The part of a step that its kernels are known to take: forces once per stage of an explicit scheme; tangent and
// forces once per nonlinear iteration, forces once more per substep, and the linear iterations of an implicit one.
// Energies of line searches and factorisations are not counted. Nothing for schemes that sweep, xpbd and vbd.
std::optional<double> calc_kernel_share(const TimeSettings& time, const StepTimes& steps, const KernelTimes& kernels);

}  // namespace flexcast
