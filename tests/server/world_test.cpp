#include "server/world.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/server/worlds.h"

namespace flexcast::server {
namespace {

using namespace test;

WorldOptions started_until(double time) {
  WorldOptions options;
  options.until = time;
  return options;
}

// ---------------------------------------------------------------- frames

TEST(World, TheInitialStateIsFrame0AndEveryStepIsAFrame) {
  TestWorld world;
  world.run(5);
  ASSERT_EQ(world.frames().size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(world.frames()[i].frame, i);
    EXPECT_EQ(world.frames()[i].step, static_cast<std::int64_t>(i));
    EXPECT_EQ(world.frames()[i].run_id, world->run_id());
  }
}

TEST(World, FramesStayContiguousWhenOnlyEveryNthStepIsPublished) {
  TestWorld world({}, "[stream]\nevery = 3\n");
  world.run(10);
  ASSERT_EQ(world.frames().size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(world.frames()[i].frame, i);
    EXPECT_EQ(world.frames()[i].step, static_cast<std::int64_t>(3 * i));
  }
}

// ---------------------------------------------------------------- pause, step, run_until

TEST(World, PauseAndResumeMayBeRepeated) {
  TestWorld world;
  world.run(3);
  for (int i = 0; i < 2; ++i) {
    const Reply reply = world.ask(pause());
    EXPECT_EQ(reply.outcome, Outcome::applied);
    EXPECT_EQ(reply.state, WorldState::paused);
  }
  for (int i = 0; i < 2; ++i) EXPECT_EQ(world.ask(resume()).state, WorldState::running);
}

TEST(World, StepIsAnsweredWhenTheStepsAreDoneAndThenThePauseHolds) {
  TestWorld world(started_paused());
  const Command command = step(3);
  world.apply(command);
  EXPECT_FALSE(world.is_answered(command));
  world.run(100);
  EXPECT_EQ(world.step_now(), 3);
  const Reply reply = world.reply_to(command);
  EXPECT_EQ(reply.outcome, Outcome::applied);
  EXPECT_EQ(reply.applied_step, 3);
  EXPECT_EQ(reply.state, WorldState::paused);
  ASSERT_TRUE(reply.report.has_value());
  EXPECT_EQ(reply.report->report.step, 3);
}

TEST(World, StepIsForStandingWorldsOnly) {
  TestWorld world;
  EXPECT_EQ(world.ask(step(1)).outcome, Outcome::wrong_state);
  world.apply(pause());
  EXPECT_EQ(world.ask(step(0)).outcome, Outcome::rejected);
  EXPECT_EQ(world.ask(step(std::numeric_limits<std::uint64_t>::max())).outcome, Outcome::rejected);
}

TEST(World, RunUntilPausesAtTheNearestStepAndAnswersThen) {
  TestWorld world(started_paused());
  const Command command = run_until(0.0504);
  world.apply(command);
  EXPECT_FALSE(world.is_answered(command));
  EXPECT_TRUE(world->running());
  world.run(1000);
  const Reply reply = world.reply_to(command);
  EXPECT_EQ(reply.outcome, Outcome::applied);
  EXPECT_EQ(reply.applied_step, 50);
  EXPECT_EQ(reply.state, WorldState::paused);
}

TEST(World, RunUntilThePresentIsAnsweredWithoutAStepAndThePastIsRefused) {
  TestWorld world(started_paused());
  world.apply(step(10));
  world.run(100);
  const Command command = run_until(0.010);
  world.apply(command);
  world.run(100);
  EXPECT_EQ(world.reply_to(command).outcome, Outcome::applied);
  EXPECT_EQ(world.step_now(), 10);
  EXPECT_EQ(world.ask(run_until(0.005)).outcome, Outcome::rejected);
  EXPECT_EQ(world.ask(run_until(nan)).outcome, Outcome::rejected);
  EXPECT_EQ(world.ask(run_until(1e300)).outcome, Outcome::rejected);
}

TEST(World, WhatStopsAWorldEarlyAnswersTheOpenGoal) {
  for (const Command& stopping : {pause(), reset(), run_until(0.5)}) {
    TestWorld world;
    const Command goal = run_until(1.0);
    world.apply(goal);
    world.run(10);
    world.apply(stopping);
    EXPECT_EQ(world.reply_to(goal).outcome, Outcome::wrong_state);
    EXPECT_FALSE(world.reply_to(goal).reason.empty());
    EXPECT_EQ(world.count_replies(goal), 1);
  }
  TestWorld world;
  const Command goal = run_until(1.0);
  world.apply(goal);
  world->close();
  EXPECT_EQ(world->take_replies().size(), 1u);
}

TEST(World, RunUntilFollowsAChangedTimeStep) {
  TestWorld world;
  const Command goal = run_until(0.1);
  world.apply(goal);
  world.run(50);
  world.apply(set({{"time.step", 0.0005}}));
  world.run(1000);
  EXPECT_EQ(world.reply_to(goal).applied_step, 150);
  EXPECT_NEAR(world.reply_to(goal).time, 0.1, 1e-12);
}

// ---------------------------------------------------------------- the end

TEST(World, FinishesAfterRoundUntilOverStepSteps) {
  TestWorld world(started_until(0.0204));
  world.run(1000);
  EXPECT_EQ(world.step_now(), 20);
  EXPECT_EQ(world->state(), WorldState::finished);
  EXPECT_EQ(world.frames().back().step, 20);
  TestWorld at_once(started_until(0.0));
  at_once.run(1000);
  EXPECT_EQ(at_once.step_now(), 0);
  EXPECT_EQ(at_once->state(), WorldState::finished);
}

TEST(World, AnEndTooFarToCountIsNoEnd) {
  TestWorld world(started_until(1e300));
  world.run(10);
  EXPECT_EQ(world.step_now(), 10);
  EXPECT_TRUE(world->running());
}

TEST(World, FromTheEndOnlyStepsGoalsAndResetGoOn) {
  TestWorld world(started_until(0.02));
  world.run(1000);
  EXPECT_EQ(world.ask(resume()).outcome, Outcome::wrong_state);
  const Command more = step(5);
  world.apply(more);
  world.run(1000);
  EXPECT_EQ(world.reply_to(more).applied_step, 25);
  EXPECT_EQ(world->state(), WorldState::paused);
  world.apply(reset());
  EXPECT_EQ(world->state(), WorldState::paused);
  world.apply(resume());
  world.run(1000);
  EXPECT_EQ(world->state(), WorldState::finished);
  world.apply(reset());
  EXPECT_EQ(world->state(), WorldState::running);
}

}  // namespace
}  // namespace flexcast::server
