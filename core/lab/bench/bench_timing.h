// Times of several tasks that take turns, A B C A B C ..., so that a drift of the machine falls on all of them alike.
#pragma once

#include <functional>
#include <vector>

namespace flexcast {

struct TurnSettings {
  double sample = 1e-3;  // s: a shorter task is repeated until a sample lasts that long
  int turns = 61;        // at most
  int least_turns = 5;
  double budget = 5.0;  // s: no further turn begins once this has passed, but for the least number
};

class Turns {
 public:
  // `task` does its work once. `prepare` is called before each of its samples and not timed.
  void add(std::function<void()> task, std::function<void()> prepare = {});

  std::size_t count() const { return tasks_.size(); }

  // Median seconds of one run of every task, in the order of add.
  std::vector<double> measure(const TurnSettings& settings = {}) const;

 private:
  struct Task {
    std::function<void()> run, prepare;
  };
  std::vector<Task> tasks_;
};

// Of at least one value; the upper one of two in the middle.
double calc_median(std::vector<double> values);

}  // namespace flexcast
