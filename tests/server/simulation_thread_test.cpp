#include "server/simulation_thread.h"

#include <gtest/gtest.h>

#include "tests/server/worlds.h"

namespace flexcast::server {
namespace {

using namespace test;

// The thread's loop with both ends in the test's hands; turned by hand, or for real after start().
struct Bench {
  explicit Bench(WorldOptions options = {.rate = 0.0}, const FrameLimits& limits = {.frames = 8})
      : world(load(rope_scene()), options, run_ids),
        mailbox(world.simulation().model().particle_count(), {}, limits),
        thread(world, commands, replies, mailbox) {}

  void turn(int times) {
    for (int i = 0; i < times; ++i) thread.turn(Clock::now());
  }
  std::vector<std::uint64_t> take_frame_numbers() {
    std::vector<std::uint64_t> numbers;
    while (const Frame* frame = mailbox.take()) numbers.push_back(frame->header.frame);
    return numbers;
  }
  WorldStatus ask_status() {
    mailbox.take_status();
    mailbox.want_status();
    turn(1);
    return mailbox.take_status().value();
  }
  // Waits for the real thread; the time limit only ends a test that hangs.
  Reply wait_reply(std::uint64_t request_id) {
    const auto limit = Clock::now() + std::chrono::seconds(60);
    while (Clock::now() < limit) {
      for (Reply& reply : replies.take_all()) {
        if (reply.key.request_id == request_id) return reply;
      }
      replies.wait_for(std::chrono::milliseconds(100));
    }
    throw std::runtime_error("no reply came");
  }

  RunIds run_ids;
  World world;
  Queue<Command> commands;
  Queue<Reply> replies;
  FrameMailbox mailbox;
  SimulationThread thread;
};

TEST(SimulationThread, HandsOnTheInitialStateAndEveryStep) {
  Bench bench;
  bench.turn(3);
  EXPECT_EQ(bench.take_frame_numbers(), (std::vector<std::uint64_t>{0, 1, 2, 3}));
}

TEST(SimulationThread, AFullMailboxSkipsFramesCountsThemAndNeverWaits) {
  Bench bench({.rate = 0.0}, {.frames = 4});
  bench.turn(10);  // frames 0 to 10
  EXPECT_EQ(bench.world.simulation().state().step, 10);
  EXPECT_EQ(bench.take_frame_numbers(), (std::vector<std::uint64_t>{0, 1, 2, 3}));
  bench.commands.push(pause());
  const WorldStatus status = bench.ask_status();
  EXPECT_EQ(status.frames_skipped, 6u);                                     // 4 to 9
  EXPECT_EQ(bench.take_frame_numbers(), (std::vector<std::uint64_t>{10}));  // found room when the world stood
  EXPECT_TRUE(bench.thread.handed_over());
}

TEST(SimulationThread, CommandsActBetweenTwoStepsInTheOrderTheyCame) {
  Bench bench;
  bench.turn(5);
  const Command first = set({{"rope.stiffness", 50.0}});
  const Command second = pause();
  bench.commands.push(first);
  bench.commands.push(second);
  bench.turn(3);
  const auto replies = bench.replies.take_all();
  ASSERT_EQ(replies.size(), 2u);
  EXPECT_EQ(replies[0].key.request_id, first.key.request_id);
  EXPECT_EQ(replies[0].applied_step, 5);
  EXPECT_EQ(replies[1].applied_step, 5);
  EXPECT_EQ(bench.world.simulation().state().step, 5);
}

TEST(SimulationThread, TheReplyToAStepFollowsItsFrame) {
  Bench bench({.rate = 0.0, .paused = true});
  bench.take_frame_numbers();
  bench.commands.push(step(2));
  bench.turn(1);
  EXPECT_EQ(bench.replies.size(), 0u);
  bench.turn(1);
  ASSERT_EQ(bench.replies.size(), 1u);
  EXPECT_EQ(bench.take_frame_numbers(), (std::vector<std::uint64_t>{1, 2}));
}

TEST(SimulationThread, TheHeartbeatBeatsAlsoWhileTheWorldStands) {
  Bench bench({.rate = 0.0, .paused = true});
  const auto before = bench.mailbox.heartbeat();
  bench.turn(3);
  EXPECT_EQ(bench.mailbox.heartbeat(), before + 3);
  EXPECT_EQ(bench.world.simulation().state().step, 0);
}

TEST(SimulationThread, APacedWorldWaitsForItsTime) {
  Bench bench({.rate = 1.0});
  const Clock::time_point now = Clock::now();
  EXPECT_GT(bench.thread.turn(now), Clock::duration::zero());
  EXPECT_EQ(bench.world.simulation().state().step, 0);
  bench.thread.turn(now + from_seconds(rope_step) + std::chrono::microseconds(1));
  EXPECT_EQ(bench.world.simulation().state().step, 1);
}

TEST(SimulationThread, EachResetCountsSkippedFramesAnew) {
  Bench bench({.rate = 0.0}, {.frames = 4});
  bench.turn(10);
  bench.take_frame_numbers();
  bench.commands.push(pause());
  bench.commands.push(reset());
  EXPECT_EQ(bench.ask_status().frames_skipped, 0u);
  EXPECT_EQ(bench.take_frame_numbers().back(), 0u);
}

TEST(SimulationThread, APacedWorldGoesOnAtItsPaceAfterARestoreInEitherDirection) {
  const Folder folder;
  Bench bench({.rate = 1.0, .checkpoints = folder.path()});
  Clock::time_point now = Clock::now();
  const auto run_seconds = [&](double simulated) {
    const auto end = now + from_seconds(simulated);
    while (now < end) {
      const auto wait = bench.thread.turn(now);
      now += std::clamp<Clock::duration>(wait, std::chrono::microseconds(1), std::chrono::milliseconds(1));
    }
  };
  bench.commands.push(save("early"));
  run_seconds(1.0);
  bench.commands.push(save("late"));
  bench.commands.push(restore("early"));
  run_seconds(0.1);
  EXPECT_NEAR(static_cast<double>(bench.world.simulation_state().step), 100.0, 5.0);
  bench.commands.push(restore("late"));
  run_seconds(0.1);
  EXPECT_NEAR(static_cast<double>(bench.world.simulation_state().step), 1100.0, 10.0);
}

TEST(SimulationThread, ARestoredStateIsHandedOnAsTheNextFrame) {
  const Folder folder;
  Bench bench({.rate = 0.0, .checkpoints = folder.path()}, {.frames = 4});
  bench.commands.push(save("start"));
  bench.turn(10);  // the mailbox is full: the newest frame waits for room
  EXPECT_EQ(bench.take_frame_numbers(), (std::vector<std::uint64_t>{0, 1, 2, 3}));
  bench.commands.push(pause());
  bench.commands.push(restore("start"));
  bench.turn(1);
  const Frame* frame = bench.mailbox.take();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->header.frame, 10u);
  frame = bench.mailbox.take();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->header.frame, 11u);
  EXPECT_EQ(frame->header.step, 0);
  EXPECT_EQ(frame->state_hash, bench.world.simulation().calc_state_hash());
}

TEST(SimulationThread, AfterALoadFramesHaveTheNewScenesParticles) {
  WorldOptions options{.rate = 0.0};
  options.load_scene = [](const std::string&) {
    std::string text = rope_scene();
    return load_scene_text(text.replace(text.find("cells = [10]"), 12, "cells = [30]"));
  };
  Bench bench(options);
  bench.turn(2);
  bench.commands.push(load_scene("other"));
  bench.turn(2);
  std::vector<std::pair<std::uint64_t, std::size_t>> frames;  // number, coordinates
  while (const Frame* frame = bench.mailbox.take()) {
    const std::size_t coordinates = frame->payload.positions.size();
    frames.emplace_back(frame->header.frame, coordinates);
    EXPECT_EQ(frame->header.topology_revision, coordinates == 33 ? 1u : 2u);
  }
  EXPECT_EQ(frames,
            (std::vector<std::pair<std::uint64_t, std::size_t>>{{0, 33}, {1, 33}, {2, 33}, {0, 93}, {1, 93}, {2, 93}}));
}

TEST(SimulationThread, EveryStateChangeGivesAStatus) {
  Bench bench;
  bench.turn(1);
  bench.mailbox.take_status();
  bench.turn(5);
  EXPECT_FALSE(bench.mailbox.take_status().has_value());
  bench.commands.push(pause());
  bench.turn(1);
  EXPECT_EQ(bench.mailbox.take_status().value().state, WorldState::paused);
}

TEST(SimulationThread, RunsUntilItsEndOnItsOwnThreadAndLivesOn) {
  Bench bench({.rate = 0.0, .until = 0.05});
  bench.thread.start();
  const Command goal = run_until(0.1);
  bench.commands.push(goal);
  const Reply arrived = bench.wait_reply(goal.key.request_id);
  EXPECT_EQ(arrived.outcome, Outcome::applied);
  EXPECT_EQ(arrived.applied_step, 100);
  const Command again = reset();
  bench.commands.push(again);
  EXPECT_EQ(bench.wait_reply(again.key.request_id).outcome, Outcome::applied);
  bench.thread.stop();
}

TEST(SimulationThread, LivesOnAfterAFailure) {
  Bench bench;
  bench.thread.start();
  bench.commands.push(set_explosive());
  const Command goal = run_until(1000.0);
  bench.commands.push(goal);
  EXPECT_EQ(bench.wait_reply(goal.key.request_id).outcome, Outcome::wrong_state);
  const Command again = reset();
  bench.commands.push(again);
  EXPECT_EQ(bench.wait_reply(again.key.request_id).outcome, Outcome::applied);
  bench.thread.stop();
}

TEST(SimulationThread, EndingAnswersWhatIsOpen) {
  Bench bench;
  bench.thread.start();
  const Command goal = run_until(1e6);
  bench.commands.push(goal);
  const Command marker = make_command(CommandKind::status, StatusCommand{});
  bench.commands.push(marker);
  bench.wait_reply(marker.key.request_id);
  bench.thread.stop();
  EXPECT_EQ(bench.wait_reply(goal.key.request_id).outcome, Outcome::wrong_state);
}

}  // namespace
}  // namespace flexcast::server
