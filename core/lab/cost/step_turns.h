// Steps of several simulations that take turns, A B C A B C ..., each going its own way, so that a drift of the machine
// falls on all of them alike.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/sim/simulation.h"

namespace flexcast {

struct StepTurnSettings {
  int steps = 500;       // of each, at most
  double budget = 20.0;  // s: as many rounds as fit, but for the least number
  double sample = 2e-4;  // s: shorter steps are timed several in a row; longer samples would be interrupted more often
  int least_rounds = 5;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(int round, int rounds)> progress = {};
};

// What was timed of one simulation.
struct SteppedSimulation {
  std::vector<double> seconds;                       // a step, of every round
  double iterations = 0.0, linear_iterations = 0.0;  // mean of the steps
  std::string failure;                               // "": none. A simulation that failed takes no further turns
};

struct SteppedTurns {
  int steps = 0;  // of each that did not fail
  bool stopped = false;
  std::vector<SteppedSimulation> simulations;  // in their order
};

// Steps them all: a few times untimed, then in rounds. Ends early when the first one fails.
SteppedTurns step_in_turns(const std::vector<std::unique_ptr<Simulation>>& simulations,
                           const StepTurnSettings& settings);

}  // namespace flexcast
