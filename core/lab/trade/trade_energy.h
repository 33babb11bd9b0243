// How well the books of energy close over a run, as one number.
#pragma once

#include "core/sim/simulation.h"

namespace flexcast {

class TradeEnergy {
 public:
  // Adds the present state.
  void add(const Simulation& simulation);
  // (largest |numerical| + largest drift of the closed books) / largest kinetic + elastic; 0 where nothing has energy.
  double calc_error() const;

 private:
  bool begun_ = false;
  double start_ = 0.0, drift_ = 0.0, numerical_ = 0.0, scale_ = 0.0;  // J
};

}  // namespace flexcast
