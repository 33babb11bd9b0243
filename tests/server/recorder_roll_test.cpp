#include "server/recorder_roll.h"

#include <gtest/gtest.h>

namespace flexcast::server {
namespace {

constexpr std::uint64_t this_run = 7;
constexpr std::size_t history = 20;
const std::uint64_t window = RecorderRoll::calc_window(history, 64);

RecorderRoll::Position at(std::uint64_t frame, std::uint64_t run_id = this_run) {
  return {.run_id = run_id, .frame = frame, .mailbox = 64};
}
RecorderRoll::Standing has(std::uint64_t next_frame, std::uint64_t run_id = this_run) {
  return {.paused = false, .run_id = run_id, .next_frame = next_frame};
}

TEST(RecorderRoll, NobodyHoldsAWorldWithoutRecorders) {
  RecorderRoll roll({.history = history});
  EXPECT_TRUE(roll.may_step(at(1000)));
  EXPECT_TRUE(roll.have_all(at(1000)));
  EXPECT_TRUE(roll.calc_waits(at(1000)).empty());
}

TEST(RecorderRoll, TheNewestFrameStaysWithinTheWindowOfTheSlowestRecorder) {
  RecorderRoll roll({.history = history});
  roll.note("fast", has(100));
  roll.note("slow", has(50));
  EXPECT_TRUE(roll.may_step(at(50 + window - 1)));
  EXPECT_FALSE(roll.may_step(at(50 + window)));
  const auto waits = roll.calc_waits(at(50 + window));
  ASSERT_EQ(waits.size(), 1u);
  EXPECT_NE(waits[0].find("'slow'"), std::string::npos) << waits[0];
  roll.note("slow", has(51));
  EXPECT_TRUE(roll.may_step(at(50 + window)));
}

TEST(RecorderRoll, ARecorderHoldsTheWorldUntilItHasAFrameOfTheRun) {
  RecorderRoll roll({.history = history});
  roll.note("new", has(0));
  EXPECT_FALSE(roll.may_step(at(0)));
  roll.note("new", has(1));
  EXPECT_TRUE(roll.may_step(at(0)));
  EXPECT_FALSE(roll.may_step(at(0, this_run + 1)));  // a reset; it may still lack frames of the old run
  roll.note("new", has(1, this_run + 1));
  EXPECT_TRUE(roll.may_step(at(0, this_run + 1)));
}

TEST(RecorderRoll, APausedRecorderAndOneThatIsGoneHoldNothing) {
  RecorderRoll roll({.history = history});
  roll.note("one", has(1));
  roll.note("two", has(1));
  EXPECT_FALSE(roll.may_step(at(1000)));
  roll.note("one", {.paused = true, .run_id = this_run, .next_frame = 1});
  EXPECT_FALSE(roll.may_step(at(1000)));
  roll.forget("two");
  EXPECT_TRUE(roll.may_step(at(1000)));
  roll.note("one", has(1));
  EXPECT_FALSE(roll.may_step(at(1000)));
}

TEST(RecorderRoll, TheFirstStepWaitsForAsManyRecordersAsItWasTold) {
  RecorderRoll roll({.recorders = 2, .history = history});
  EXPECT_FALSE(roll.may_step(at(0)));
  ASSERT_EQ(roll.calc_waits(at(0)).size(), 1u);
  roll.note("one", has(1));
  roll.note("two", has(0));
  EXPECT_FALSE(roll.may_step(at(0)));
  roll.note("two", has(1));
  EXPECT_TRUE(roll.may_step(at(0)));
  roll.forget("two");  // later on nobody is missed
  EXPECT_TRUE(roll.may_step(at(0)));
  EXPECT_FALSE(roll.may_step(at(0, this_run + 1)));
}

TEST(RecorderRoll, KnowsWhetherEveryRecorderHasTheNewestFrame) {
  RecorderRoll roll({.history = history});
  roll.note("one", has(11));
  roll.note("two", has(10));
  EXPECT_FALSE(roll.have_all(at(10)));
  roll.note("two", has(11));
  EXPECT_TRUE(roll.have_all(at(10)));
  EXPECT_FALSE(roll.have_all(at(10, this_run + 1)));
}

// A frame is pushed after the roll was asked, so up to window + 1 frames are under way, of two runs at a reset.
TEST(RecorderRoll, WhatIsUnderWayFitsTwiceIntoHistoryAndMailbox) {
  for (const std::size_t frames : {4u, 5u, 8u, 64u}) {
    EXPECT_GE(RecorderRoll::calc_window(frames, 1000), 1u);
    EXPECT_LE(2 * (RecorderRoll::calc_window(frames, 1000) + 1), frames);
    EXPECT_EQ(RecorderRoll::calc_window(frames, 1000), RecorderRoll::calc_window(1000, frames));
  }
}

}  // namespace
}  // namespace flexcast::server
