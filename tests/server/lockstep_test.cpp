// The step loop in lockstep, with both ends in the test's hands.
#include <gtest/gtest.h>

#include "server/simulation_thread.h"
#include "tests/server/worlds.h"

namespace flexcast::server {
namespace {

using namespace test;
using namespace std::chrono_literals;

struct LockstepBench {
  explicit LockstepBench(WorldOptions options = {.rate = 0.0}, std::size_t mailbox_frames = 64)
      : world(load(rope_scene()), options, run_ids),
        mailbox(world.simulation().model().particle_count(), {}, {.frames = mailbox_frames}),
        thread(world, commands, replies, mailbox, &roll) {}

  void turn(int times) {
    for (int i = 0; i < times; ++i) thread.turn(Clock::now());
  }
  void note(const std::string& recorder, std::uint64_t next_frame) {
    roll.note(recorder, {.paused = false, .run_id = world.run_id(), .next_frame = next_frame});
  }
  std::int64_t step_now() const { return world.simulation().state().step; }
  std::vector<std::uint64_t> take_frame_numbers() {
    std::vector<std::uint64_t> numbers;
    while (const Frame* frame = mailbox.take()) numbers.push_back(frame->header.frame);
    return numbers;
  }

  static constexpr std::size_t history = 20;
  static std::int64_t window() { return static_cast<std::int64_t>(RecorderRoll::calc_window(history, 64)); }

  RunIds run_ids;
  World world;
  Queue<Command> commands;
  Queue<Reply> replies;
  FrameMailbox mailbox;
  RecorderRoll roll{{.recorders = 0, .history = history}};
  SimulationThread thread;
};

TEST(Lockstep, AFullMailboxHoldsTheWorldAndNoFrameIsSkipped) {
  LockstepBench bench({.rate = 0.0}, 4);
  bench.turn(10);
  EXPECT_EQ(bench.step_now(), 4);  // frame 4 waits for room
  std::vector<std::uint64_t> numbers;
  for (int i = 0; i < 20; ++i) {
    for (const std::uint64_t number : bench.take_frame_numbers()) numbers.push_back(number);
    bench.turn(3);
  }
  ASSERT_GT(numbers.size(), 50u);
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], i);
  bench.mailbox.take_status();
  bench.mailbox.want_status();
  bench.turn(1);
  EXPECT_EQ(bench.mailbox.take_status().value().frames_skipped, 0u);
}

TEST(Lockstep, TheWorldGoesAsFarAsTheWindowOfARecorderAndNoFurther) {
  LockstepBench bench;
  bench.note("slow", 1);
  bench.turn(100);
  EXPECT_EQ(bench.step_now(), 1 + LockstepBench::window());
  bench.note("slow", 5);
  bench.turn(100);
  EXPECT_EQ(bench.step_now(), 5 + LockstepBench::window());
  bench.roll.forget("slow");
  bench.turn(10);
  EXPECT_EQ(bench.step_now(), 15 + LockstepBench::window());
}

TEST(Lockstep, CommandsAndHeartbeatGoOnWhileTheWorldIsHeld) {
  LockstepBench bench;
  bench.note("slow", 0);
  bench.turn(5);
  const auto heartbeat = bench.mailbox.heartbeat();
  bench.commands.push(set({{"rope.stiffness", 50.0}}));
  bench.turn(5);
  EXPECT_EQ(bench.step_now(), 0);
  EXPECT_TRUE(bench.mailbox.held());
  EXPECT_EQ(bench.replies.size(), 1u);
  EXPECT_EQ(bench.mailbox.heartbeat(), heartbeat + 5);
  bench.note("slow", 1);
  bench.turn(1);
  EXPECT_FALSE(bench.mailbox.held());
  EXPECT_EQ(bench.step_now(), 1);
}

TEST(Lockstep, AStatusSaysForWhomTheWorldWaitsWhenItIsForLong) {
  LockstepBench bench;
  bench.note("slow", 0);
  const Clock::time_point begin = Clock::now();
  const auto warnings_at = [&](Clock::duration after) {
    bench.mailbox.take_status();
    bench.mailbox.want_status();
    bench.thread.turn(begin + after);
    return bench.mailbox.take_status().value().warnings;
  };
  EXPECT_TRUE(warnings_at(0s).empty());
  EXPECT_TRUE(warnings_at(500ms).empty());
  const auto warnings = warnings_at(2s);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("'slow'"), std::string::npos);
  bench.note("slow", 1);
  EXPECT_TRUE(warnings_at(3s).empty());
}

TEST(Lockstep, APausedWorldWaitsForNobody) {
  LockstepBench bench({.rate = 0.0, .paused = true});
  bench.note("slow", 0);
  const Clock::time_point begin = Clock::now();
  bench.thread.turn(begin);
  bench.mailbox.want_status();
  bench.thread.turn(begin + 5s);
  EXPECT_FALSE(bench.mailbox.held());
  EXPECT_TRUE(bench.mailbox.take_status().value().warnings.empty());
}

TEST(Lockstep, TheLastFrameCountsAsHandedOverWhenTheRecordersHaveIt) {
  LockstepBench bench({.rate = 0.0, .until = 0.003});
  bench.note("slow", 3);
  bench.turn(5);
  EXPECT_EQ(bench.world.state(), WorldState::finished);
  EXPECT_FALSE(bench.thread.handed_over());
  EXPECT_TRUE(bench.mailbox.held()) << "so the last frame is sent again: it may have got lost";
  bench.note("slow", 4);
  bench.turn(1);
  EXPECT_TRUE(bench.thread.handed_over());
  EXPECT_FALSE(bench.mailbox.held());
}

TEST(Lockstep, TheThreadGoesOnWhenTheRollHasChanged) {
  LockstepBench bench({.rate = 0.0, .until = 0.05});
  bench.note("slow", 0);
  bench.thread.start();
  const auto limit = Clock::now() + 60s;
  for (std::uint64_t next = 1; bench.thread.state() != WorldState::finished && Clock::now() < limit;) {
    bench.mailbox.wait_until(Clock::now() + 100ms);
    const auto numbers = bench.take_frame_numbers();
    if (!numbers.empty()) next = numbers.back() + 1;
    bench.note("slow", next);
    bench.commands.wake();
  }
  EXPECT_EQ(bench.thread.state(), WorldState::finished);
  bench.thread.stop();
}

}  // namespace
}  // namespace flexcast::server
