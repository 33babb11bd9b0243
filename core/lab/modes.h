// The verb `modes`: natural frequencies of a scene about its start or its equilibrium.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/sim/simulation.h"

namespace flexcast {

struct ModesOptions {
  std::filesystem::path scene;
  int count = 6;                // of the lowest modes
  bool at_equilibrium = false;  // about the static equilibrium instead of the start
  std::vector<std::string> overrides;
  bool json = false;
  const std::atomic<bool>* stop = nullptr;
};

struct Modes {
  std::vector<double> frequencies;  // Hz, rising; negative: an unstable direction, -sqrt(-lambda) / 2 pi
  double largest_frequency = 0.0;   // Hz
  double explicit_step = 0.0;  // s, 2 / omega of the largest: what undamped symplectic Euler allows; may be infinite
};

// Of K u = omega^2 M u over the free degrees of freedom, K the exact stiffness at the present state: all of them for
// small scenes, else Lanczos with shift and inversion (Spectra). Rigid modes have the frequency 0.
// Errors: no free degree of freedom, an iteration that does not converge.
Result<Modes> calc_modes(const Simulation& simulation, int count);

// The program's verb; returns the exit code.
int modes_verb(const ModesOptions& options, std::ostream& out, std::ostream& log);

}  // namespace flexcast
