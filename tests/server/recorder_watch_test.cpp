// The roll as it follows recorders on the network.
#include "server/recorder_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "tests/support/lockstep_recorder.h"
#include "tests/support/network.h"

namespace flexcast::server {
namespace {

using namespace std::chrono_literals;
using flexcast::test::LockstepRecorder;

constexpr std::uint64_t run = 7;

class Watched : public testing::Test {
 protected:
  Watched() { watch_->start(); }

  // Waits until the roll says so of a world at frame 0 of the run; the time limit only ends a test that hangs.
  bool wait_until_may_step(bool expected) {
    const auto limit = std::chrono::steady_clock::now() + 60s;
    while (std::chrono::steady_clock::now() < limit) {
      if (roll_.may_step({.run_id = run, .frame = 0, .mailbox = 64}) == expected) return true;
      std::this_thread::sleep_for(2ms);
    }
    return false;
  }

  wire::Participant participant_ = flexcast::test::join_test_domain();
  RecorderRoll roll_{RecorderRoll::Rules{}};
  std::atomic<int> changes_ = 0;
  std::unique_ptr<RecorderWatch> watch_ =
      RecorderWatch::create(participant_, "rope", roll_, [this] { ++changes_; }).value();
};

TEST_F(Watched, ARecorderHoldsTheWorldUntilItHasAFrame) {
  LockstepRecorder recorder(participant_, "rope", "slow");
  ASSERT_TRUE(wait_until_may_step(false));
  recorder.acknowledge({.run_id = run, .frame = 0});
  EXPECT_TRUE(wait_until_may_step(true));
  EXPECT_GE(changes_, 1);
}

TEST_F(Watched, OneThatPausesFinishesOrSaysGoodbyeHoldsItNoLonger) {
  LockstepRecorder recorder(participant_, "rope", "slow");
  for (const auto state : {flexcast_RECORDER_PAUSED, flexcast_RECORDER_FINISHED, flexcast_RECORDER_FAILED}) {
    ASSERT_TRUE(wait_until_may_step(false));
    recorder.tell(state);
    EXPECT_TRUE(wait_until_may_step(true)) << state;
    recorder.tell(flexcast_RECORDER_RECORDING);
  }
  ASSERT_TRUE(wait_until_may_step(false));
  recorder.dispose();
  EXPECT_TRUE(wait_until_may_step(true));
}

TEST_F(Watched, OneWhoseWriterIsGoneHoldsItNoLonger) {
  auto recorder = std::make_optional<LockstepRecorder>(participant_, "rope", "slow");
  ASSERT_TRUE(wait_until_may_step(false));
  recorder.reset();
  EXPECT_TRUE(wait_until_may_step(true));
}

TEST_F(Watched, RecordersOfOtherWorldsAreNotOnTheRoll) {
  const LockstepRecorder other(participant_, "cloth", "other");
  const LockstepRecorder own(participant_, "rope", "own");
  ASSERT_TRUE(wait_until_may_step(false));
  own.dispose();
  EXPECT_TRUE(wait_until_may_step(true));
}

}  // namespace
}  // namespace flexcast::server
