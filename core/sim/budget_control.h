// The contract time.budget: the most substeps that fit into a share of the wall time a step stands for. It has no clock
// of its own: who steps the simulation measures, tells it, and hands its choice to the simulation.
#pragma once

#include <array>
#include <string>

#include "core/sim/time_choice.h"

namespace flexcast {

class Simulation;

class BudgetControl {
 public:
  // A contract begins, or what a step costs has changed altogether.
  void begin() { *this = {}; }
  // After a step of the simulation that took `seconds`: what the next ones are to be taken with. Without the contract
  // the simulation's present choice.
  TimeChoice follow(const Simulation& simulation, double seconds);
  // What a user should know: the contract cannot be kept; "" otherwise.
  const std::string& warning() const { return warning_; }

 private:
  static constexpr std::size_t window = 128;

  double calc_dear_cost() const;
  int find_least_substeps(const Simulation& simulation);

  // s a substep and a sweep, of the last steps.
  std::array<double, window> costs_ = {};
  std::size_t count_ = 0, next_ = 0, since_change_ = 0;
  std::string warning_;
};

}  // namespace flexcast
