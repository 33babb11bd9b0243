#include "clients/replay/pacer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flexcast::replay {
namespace {

using namespace std::chrono_literals;

const Clock::time_point start{1h};

Clock::duration rounded(Clock::duration wait) {
  return std::chrono::round<std::chrono::microseconds>(wait);
}

TEST(ReplayPacer, AFrameIsDueWhenItsSimulatedTimeHasPassedAtTheRate) {
  Pacer pacer(2.0);
  EXPECT_EQ(rounded(pacer.calc_wait(start, 1.0, 1.2)), 100ms);
  EXPECT_EQ(rounded(pacer.calc_wait(start + 40ms, 1.0, 1.2)), 60ms);
  EXPECT_EQ(pacer.calc_wait(start + 101ms, 1.0, 1.2), 0ms);
  EXPECT_EQ(rounded(pacer.calc_wait(start + 101ms, 1.2, 1.4)), 99ms);  // what was late is made up for
}

TEST(ReplayPacer, ZeroIsAsFastAsPossible) {
  Pacer pacer(0.0);
  EXPECT_EQ(pacer.calc_wait(start, 0.0, 1e9), 0ms);
}

TEST(ReplayPacer, WhereTimeJumpsBackTheFrameIsDueAtOnceAndThePaceStartsThere) {
  Pacer pacer(1.0);
  EXPECT_EQ(rounded(pacer.calc_wait(start, 5.0, 5.1)), 100ms);
  EXPECT_EQ(pacer.calc_wait(start + 10ms, 5.1, 0.0), 0ms);
  EXPECT_EQ(rounded(pacer.calc_wait(start + 10ms, 0.0, 0.1)), 100ms);
}

TEST(ReplayPacer, ARestartForgetsTheWallTimeInBetween) {
  Pacer pacer(1.0);
  EXPECT_EQ(rounded(pacer.calc_wait(start, 0.0, 0.1)), 100ms);
  pacer.restart();
  EXPECT_EQ(rounded(pacer.calc_wait(start + 1h, 0.0, 0.1)), 100ms);
}

TEST(ReplayPacer, AGreatDebtIsDropped) {
  Pacer pacer(1.0);
  EXPECT_EQ(rounded(pacer.calc_wait(start, 0.0, 0.1)), 100ms);
  EXPECT_EQ(pacer.calc_wait(start + 10s, 0.0, 0.1), 0ms);
  EXPECT_EQ(rounded(pacer.calc_wait(start + 10s, 0.1, 0.2)), 100ms);
}

TEST(ReplayPacer, ASpanBeyondAllBoundsIsALongWait) {
  Pacer pacer(1e-300);
  EXPECT_GT(pacer.calc_wait(start, 0.0, 1e300), 24h);
  EXPECT_EQ(pacer.calc_wait(start, 0.0, std::nan("")), 0ms);  // of a recording that went wrong
}

}  // namespace
}  // namespace flexcast::replay
