#include "server/pacer.h"

#include <gtest/gtest.h>

#include "server/rate_meter.h"
#include "server/run_ids.h"

namespace flexcast::server {
namespace {

using namespace std::chrono_literals;

constexpr double dt = 0.01;  // s

// Takes `steps` steps that cost nothing with a clock that only waiting moves. Returns when the last one was due.
Clock::time_point take_steps(Pacer& pacer, Clock::time_point now, int first, int steps) {
  for (int k = first; k < first + steps; ++k) now += pacer.calc_wait(now, k * dt, (k + 1) * dt);
  return now;
}

double seconds_between(Clock::time_point begin, Clock::time_point end) {
  return seconds(end - begin);
}

TEST(Pacer, StepKIsDueAtStartPlusKStepsWithoutAddingUpErrors) {
  Pacer pacer(1.0);
  const Clock::time_point start{};
  EXPECT_NEAR(seconds_between(start, take_steps(pacer, start, 0, 1)), dt, 1e-9);
  pacer.restart();
  EXPECT_NEAR(seconds_between(start, take_steps(pacer, start, 0, 100'000)), 100'000 * dt, 1e-5);
}

TEST(Pacer, RateScalesThePace) {
  Pacer pacer(4.0);
  const Clock::time_point start{};
  EXPECT_NEAR(seconds_between(start, take_steps(pacer, start, 0, 100)), 100 * dt / 4.0, 1e-6);
}

TEST(Pacer, RateZeroNeverWaits) {
  Pacer pacer(0.0);
  const Clock::time_point start{};
  EXPECT_EQ(take_steps(pacer, start, 0, 1000), start);
}

TEST(Pacer, SmallDebtIsCaughtUp) {
  Pacer pacer(1.0);
  const Clock::time_point start{};
  auto now = take_steps(pacer, start, 0, 10);
  now += 200ms;  // a step that took long
  now = take_steps(pacer, now, 10, 40);
  EXPECT_NEAR(seconds_between(start, now), 50 * dt, 1e-6);
}

TEST(Pacer, LargeDebtIsDroppedWithoutABurst) {
  Pacer pacer(1.0);
  auto now = take_steps(pacer, {}, 0, 10) + 10s;
  const auto resumed = now;
  now += pacer.calc_wait(now, 10 * dt, 11 * dt);
  EXPECT_EQ(now, resumed);
  now = take_steps(pacer, now, 11, 20);
  EXPECT_NEAR(seconds_between(resumed, now), 20 * dt, 1e-6);
}

TEST(Pacer, AChangedRateStartsThePaceAfresh) {
  Pacer pacer(1.0);
  auto now = take_steps(pacer, {}, 0, 10);
  const auto changed = now;
  pacer.set_rate(0.5);
  now = take_steps(pacer, now, 10, 10);
  EXPECT_NEAR(seconds_between(changed, now), 10 * dt / 0.5, 1e-6);
}

TEST(Pacer, ExtremeRatesDoNotOverflow) {
  Pacer pacer(1e-300);
  EXPECT_GT(pacer.calc_wait({}, 0.0, dt), 24h);
}

TEST(RateMeter, ReportsTheLastSecondAndNothingWhileStandingStill) {
  RateMeter meter;
  Clock::time_point now{1h};
  meter.start(now, 0.0);
  double time = 0.0;
  const auto take = [&](int steps, Clock::duration period) {
    for (int i = 0; i < steps; ++i) meter.add_step(now += period, time += dt, period / 2);
  };
  take(200, 20ms);  // half of real time
  EXPECT_NEAR(meter.real_time_factor(now), 0.5, 1e-6);
  EXPECT_NEAR(meter.step_seconds(), 0.010, 1e-9);
  take(500, 5ms);  // twice, for longer than the window
  EXPECT_NEAR(meter.real_time_factor(now), 2.0, 1e-6);
  meter.stop();
  EXPECT_EQ(meter.real_time_factor(now), 0.0);
  EXPECT_NEAR(meter.step_seconds(), 0.0025, 1e-9);
}

TEST(RunIds, GrowEvenIfTheClockStandsStillOrFallsBack) {
  std::uint64_t clock = 1000;
  RunIds ids([&] { return clock; });
  EXPECT_EQ(ids.next(), 1000u);
  EXPECT_EQ(ids.next(), 1001u);
  clock = 5;
  EXPECT_EQ(ids.next(), 1002u);
  clock = 2000;
  EXPECT_EQ(ids.next(), 2000u);
}

}  // namespace
}  // namespace flexcast::server
