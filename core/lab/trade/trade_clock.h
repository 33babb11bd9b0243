// The time a study of trades has, and who counts it. The clock is given from outside, so that what a budget allows can
// be tested without one.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace flexcast {

class TradeClock {
 public:
  virtual ~TradeClock() = default;
  virtual double now() const = 0;                     // s
  virtual double processor() const { return now(); }  // s that the program had a processor for, all threads
  virtual void stepped(std::int64_t /*count*/) {}     // that many integrator steps have been taken
};

std::unique_ptr<TradeClock> make_wall_clock();

// A clock with an end, and the wish of a user to stop before it.
class TradeBudget {
 public:
  TradeBudget(TradeClock& clock, double seconds, const std::atomic<bool>* stop = nullptr)
      : clock_(clock), start_(clock.now()), seconds_(seconds), stop_(stop) {}

  TradeClock& clock() const { return clock_; }
  double seconds() const { return seconds_; }             // in all
  double spent() const { return clock_.now() - start_; }  // s
  double left() const { return seconds_ - spent(); }      // s
  bool is_stopped() const { return stop_ && stop_->load(std::memory_order_relaxed); }

 private:
  TradeClock& clock_;
  double start_, seconds_;
  const std::atomic<bool>* stop_;
};

}  // namespace flexcast
