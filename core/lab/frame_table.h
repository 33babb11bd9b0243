// The CSV of a run: one row per frame.
#pragma once

#include <iosfwd>

#include "core/sim/simulation.h"

namespace flexcast {

class FrameTable {
 public:
  // Writes the header: step, time, energies (J), solver, elements, momenta, then for every probe its position (m) and
  // velocity (m/s).
  FrameTable(std::ostream& out, const Simulation& simulation);

  // Adds the present state. What was not computed is an empty field.
  void add(const Simulation& simulation);

 private:
  std::ostream& out_;
};

}  // namespace flexcast
