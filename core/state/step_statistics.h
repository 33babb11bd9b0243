// Cheap facts that every step yields.
#pragma once

namespace flexcast {

struct StepStatistics {
  int substeps = 0;           // integrator steps it was taken with; 0: none was taken
  double residual = 0.0;      // of the last nonlinear solve: norm over the summed norms of its terms; 0: explicit
  int iterations = 0;         // nonlinear, summed over the substeps
  int linear_iterations = 0;  // summed
  bool converged = true;      // every solve of the step reached its tolerance; linearly implicit: the linear one

  // J, summed over the substeps; the books of energies (report.h) are made of them. The forces' impulse times the mean
  // velocity: what it adds to the kinetic energy. What handles put in. What damping and friction took, >= 0.
  double force_work = 0.0, handle_work = 0.0, dissipated = 0.0;
};

}  // namespace flexcast
