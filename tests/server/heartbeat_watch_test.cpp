#include "server/heartbeat_watch.h"

#include <gtest/gtest.h>

namespace flexcast::server {
namespace {

using namespace std::chrono_literals;

TEST(HeartbeatWatch, IsSilentWhenTheHeartbeatStandsStillForLong) {
  HeartbeatWatch watch;
  const Clock::time_point begin = Clock::now();
  EXPECT_FALSE(watch.is_silent(begin, 7));
  EXPECT_FALSE(watch.is_silent(begin + HeartbeatWatch::long_silence - 1ms, 7));
  EXPECT_TRUE(watch.is_silent(begin + HeartbeatWatch::long_silence, 7));
  EXPECT_TRUE(watch.is_silent(begin + 10 * HeartbeatWatch::long_silence, 7));
}

TEST(HeartbeatWatch, EveryBeatEndsTheSilence) {
  HeartbeatWatch watch;
  Clock::time_point now = Clock::now();
  for (std::uint64_t beat = 0; beat < 10; ++beat) {
    now += 2 * HeartbeatWatch::long_silence;
    EXPECT_FALSE(watch.is_silent(now, beat));
  }
  EXPECT_TRUE(watch.is_silent(now + HeartbeatWatch::long_silence, 9));
}

}  // namespace
}  // namespace flexcast::server
