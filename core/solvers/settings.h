// Settings of the implicit schemes: the scene's [solver] table.
#pragma once

#include <string>

namespace flexcast {

struct SolverSettings {
  std::string linear = "auto";     // auto | pcg | ldlt
  double linear_tolerance = 1e-6;  // relative residual of the linear solver
  int newton_iterations = 20;      // at most; 1: linearly implicit
  double newton_tolerance = 1e-8;  // norm of the residual over the summed norms of its terms
  int iterations = 10;             // sweeps of position-based schemes
};

}  // namespace flexcast
