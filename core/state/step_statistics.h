// Cheap facts that every step yields.
#pragma once

namespace flexcast {

struct StepStatistics {
  double residual = 0.0;      // of the last nonlinear solve: norm over the summed norms of its terms; 0: explicit
  int iterations = 0;         // nonlinear, summed over the substeps
  int linear_iterations = 0;  // summed
  bool converged = true;      // every solve of the step reached its tolerance; linearly implicit: the linear one
};

}  // namespace flexcast
