// What commands do to a world besides moving it: parameters, reset, recovery, events.
#include "server/world.h"

#include <gtest/gtest.h>


#include "tests/server/worlds.h"

namespace flexcast::server {
namespace {

using namespace test;

// ---------------------------------------------------------------- set, get, describe

TEST(World, SetActsBetweenTheStepItNamesAndTheNext) {
  TestWorld world;
  const auto reference = flexcast::test::make(rope_scene());
  world.run(120);
  const Reply reply = world.ask(set({{"rope.stiffness", 50.0}}));
  EXPECT_EQ(reply.outcome, Outcome::applied);
  EXPECT_EQ(reply.applied_step, 120);
  EXPECT_DOUBLE_EQ(reply.time, 0.12);
  world.run(30);
  flexcast::test::run(*reference, 120);
  ASSERT_TRUE(reference->set_parameters(std::vector<ParameterAssignment>{{"rope.stiffness", 50.0}}));
  flexcast::test::run(*reference, 30);
  EXPECT_EQ(world.simulation().calc_state_hash(), reference->calc_state_hash());
}

TEST(World, SetAnswersWithTheValuesInForceAndTheNewRevision) {
  TestWorld world;
  const Reply reply = world.ask(set({{"rope.stiffness", std::int64_t{50}}, {"server.rate", 0.0}}));
  ASSERT_EQ(reply.outcome, Outcome::applied) << reply.reason;
  EXPECT_GT(reply.parameter_revision, 1u);
  ASSERT_EQ(reply.values.size(), 2u);
  EXPECT_EQ(reply.values[0].value, ParameterValue(50.0));
  EXPECT_EQ(reply.values[1].value, ParameterValue(0.0));
  EXPECT_EQ(world->rate(), 0.0);
  const auto published = world.notices_of<ParametersChanged>().back();
  EXPECT_EQ(published.parameter_revision, reply.parameter_revision);
  EXPECT_EQ(published.values.size(), published.descriptors.size());
}

TEST(World, ABatchIsAllOrNothingAcrossSimulationAndServer) {
  const std::vector<std::vector<ParameterAssignment>> bad = {
      {{"server.rate", 3.0}, {"rope.stiffness", 50.0}, {"rope.stiffnes", 1.0}},
      {{"server.rate", 3.0}, {"rope.stiffness", -1.0}},
      {{"rope.stiffness", 50.0}, {"server.rate", -1.0}},
      {{"rope.stiffness", 50.0}, {"server.rate", nan}},
      {{"rope.stiffness", 50.0}, {"server.rate", std::string("fast")}},
      {{"server.rate", 3.0}, {"rope.stiffness", nan}},
      {{"server.rate", 3.0}, {"rope.stiffness", Vec3(1, 2, 3)}},
      {{"server.rate", 3.0}, {"time.integrator", std::string("magic")}},
      {},
  };
  TestWorld world;
  for (const auto& values : bad) {
    const Reply reply = world.ask(set(values));
    EXPECT_EQ(reply.outcome, Outcome::rejected);
    EXPECT_FALSE(reply.reason.empty());
    EXPECT_EQ(reply.parameter_revision, 1u);
  }
  EXPECT_EQ(world->rate(), 1.0);
  EXPECT_EQ(world.parameter("rope.stiffness"), 100.0);
  for (const Event& event : world.events()) EXPECT_NE(event.kind, EventKind::command);
}

TEST(World, AnUnexpectedRevisionIsRefused) {
  TestWorld world;
  Command command = set({{"rope.stiffness", 50.0}});
  command.expected_revision = 2;
  EXPECT_EQ(world.ask(command).outcome, Outcome::rejected);
  command = set({{"rope.stiffness", 50.0}});
  command.expected_revision = 1;
  EXPECT_EQ(world.ask(command).outcome, Outcome::applied);
}

TEST(World, AnExpiredCommandChangesNothing) {
  TestWorld world;
  Command command = set({{"rope.stiffness", 50.0}});
  command.deadline = Clock::now() - std::chrono::seconds(1);
  EXPECT_EQ(world.ask(command).outcome, Outcome::expired);
  EXPECT_EQ(world.parameter("rope.stiffness"), 100.0);
}

TEST(World, GetAndDescribeIncludeTheServersOwnRow) {
  TestWorld world;
  const Reply all = world.ask(make_command(CommandKind::get, GetCommand{}));
  EXPECT_EQ(all.values.back().name, "server.rate");
  const Reply one = world.ask(make_command(CommandKind::get, GetCommand{{"server.rate", "gravity"}}));
  ASSERT_EQ(one.values.size(), 2u);
  EXPECT_EQ(one.values[0].value, ParameterValue(1.0));
  EXPECT_EQ(world.ask(make_command(CommandKind::get, GetCommand{{"nothing"}})).outcome, Outcome::rejected);
  const Reply described = world.ask(make_command(CommandKind::describe, DescribeCommand{}));
  ASSERT_EQ(described.descriptors.size(), described.values.size());
  EXPECT_EQ(described.descriptors.back().name, "server.rate");
  EXPECT_FALSE(described.descriptors.back().row->description.empty());
}

TEST(World, AMalformedCommandIsRefusedWithItsReason) {
  TestWorld world;
  const Reply malformed = world.ask(make_command(CommandKind::set, MalformedCommand{"a reason"}));
  EXPECT_EQ(malformed.outcome, Outcome::rejected);
  EXPECT_EQ(malformed.reason, "a reason");
}

// ---------------------------------------------------------------- reset

TEST(World, ResetBeginsANewRunAtStep0Frame0Event0) {
  TestWorld world;
  world.run(10);
  const auto run_before = world->run_id();
  const Reply reply = world.ask(reset());
  EXPECT_GT(reply.run_id, run_before);
  EXPECT_EQ(reply.applied_step, 0);
  EXPECT_EQ(reply.state, WorldState::running);
  EXPECT_EQ(world.frames().back().frame, 0u);
  EXPECT_EQ(world.frames().back().run_id, reply.run_id);
  EXPECT_EQ(world.notices_of<RunStarted>().back().run_id, reply.run_id);
  EXPECT_EQ(world.notices_of<ParametersChanged>().back().run_id, reply.run_id);
  world.run(1);
  EXPECT_EQ(world.frames().back().frame, 1u);
}

TEST(World, ResetRestoresParametersUnlessTheyAreKept) {
  TestWorld world;
  world.apply(set({{"rope.stiffness", 50.0}, {"server.rate", 0.5}}));
  world.apply(reset(true));
  EXPECT_EQ(world.parameter("rope.stiffness"), 50.0);
  EXPECT_EQ(world->rate(), 0.5);
  const auto events = world.events();
  const auto kept =
      std::find_if(events.rbegin(), events.rend(), [](const Event& event) { return event.kind == EventKind::command; });
  ASSERT_NE(kept, events.rend());
  EXPECT_TRUE(kept->keep_parameters);
  EXPECT_EQ(kept->values.size(), 2u);  // the new run is determined without the events of the old one
  const auto revision = world.ask(reset()).parameter_revision;
  EXPECT_EQ(world.parameter("rope.stiffness"), 100.0);
  EXPECT_EQ(world->rate(), 1.0);
  EXPECT_GT(revision, 2u);
}

TEST(World, AStandingWorldStandsAfterReset) {
  TestWorld world(started_paused());
  world.apply(step(5));
  world.run(100);
  EXPECT_EQ(world.ask(reset()).state, WorldState::paused);
}

// ---------------------------------------------------------------- failure

TEST(World, AStepThatCannotBeTakenLeavesItFailedAtTheLastGoodState) {
  TestWorld world;
  world.run(5);
  world.apply(set_explosive());
  world.run(1000);
  ASSERT_EQ(world->state(), WorldState::failed);
  const WorldStatus status = world->calc_status();
  ASSERT_TRUE(status.failure.has_value());
  EXPECT_EQ(status.failure->step, world.step_now() + 1);
  EXPECT_FALSE(status.failure->cause.empty());
  EXPECT_EQ(world.frames().back().step, world.step_now());
  EXPECT_EQ(world.events().back().kind, EventKind::state);
  EXPECT_EQ(world.events().back().state, WorldState::failed);
}

TEST(World, AFailedWorldRefusesToMoveUntilSetOrReset) {
  TestWorld world;
  world.apply(set_explosive());
  world.run(1000);
  for (const Command& command : {resume(), step(1), run_until(1.0), pause()}) {
    const Reply reply = world.ask(command);
    EXPECT_EQ(reply.outcome, Outcome::wrong_state);
    EXPECT_NE(reply.reason.find("reset"), std::string::npos);
  }
  const Reply repaired = world.ask(set({{"rope.stiffness", 100.0}}));
  EXPECT_EQ(repaired.outcome, Outcome::applied);
  EXPECT_EQ(repaired.state, WorldState::paused);
  EXPECT_FALSE(world->calc_status().failure.has_value());
  world.apply(set_explosive());
  world.apply(resume());
  world.run(1000);
  ASSERT_EQ(world->state(), WorldState::failed);
  EXPECT_EQ(world.ask(reset()).state, WorldState::running);
}

TEST(World, AFailureAnswersTheOpenGoal) {
  TestWorld world(started_paused());
  world.apply(set_explosive());
  const Command command = step(100'000);
  world.apply(command);
  world.run(100'000);
  EXPECT_EQ(world.reply_to(command).outcome, Outcome::wrong_state);
  EXPECT_EQ(world.reply_to(command).state, WorldState::failed);
}

TEST(World, WarnsWhenAChangeMakesTheStepUnstable) {
  TestWorld world(started_paused());
  EXPECT_TRUE(world->calc_status().warnings.empty());
  world.apply(set_explosive());
  EXPECT_FALSE(world->calc_status().warnings.empty());
  EXPECT_EQ(world.events().back().kind, EventKind::warning);
  world.apply(set({{"rope.stiffness", 100.0}}));
  EXPECT_TRUE(world->calc_status().warnings.empty());
}

// ---------------------------------------------------------------- events

TEST(World, EventsAreNumberedContiguouslyWithinARun) {
  TestWorld world;
  world.run(3);
  world.apply(pause());
  world.apply(set({{"rope.stiffness", 50.0}}));
  world.apply(step(2));
  world.run(10);
  world.apply(reset());
  world.apply(resume());
  std::uint64_t run = 0;
  std::uint64_t expected = 0;
  for (const Event& event : world.events()) {
    if (event.run_id != run) expected = 0;
    run = event.run_id;
    EXPECT_EQ(event.index, expected++);
  }
  EXPECT_GT(expected, 1u);
}

TEST(World, EveryCommandThatChangedSomethingIsAnEventAndNoOther) {
  TestWorld world;
  world.run(7);
  const Command change = set({{"rope.stiffness", 50.0}});
  world.apply(change);
  world.apply(pause());
  world.apply(pause());
  world.apply(make_command(CommandKind::get, GetCommand{}));
  world.apply(make_command(CommandKind::status, StatusCommand{}));
  std::vector<CommandKind> kinds;
  for (const Event& event : world.events()) {
    if (event.kind == EventKind::command) kinds.push_back(event.command);
    if (event.kind == EventKind::command && event.command == CommandKind::set) {
      EXPECT_EQ(event.step, 7);
      EXPECT_EQ(event.key.client_id, "tester");
      EXPECT_EQ(event.key.request_id, change.key.request_id);
      EXPECT_EQ(event.values.at(0).value, ParameterValue(50.0));
    }
  }
  EXPECT_EQ(kinds, (std::vector{CommandKind::set, CommandKind::pause}));
}

TEST(World, StatusShowsProbesAndTheReport) {
  TestWorld world;
  world.run(3);
  const WorldStatus status = world->calc_status();
  EXPECT_EQ(status.report.report.step, 3);
  ASSERT_EQ(status.probes.size(), 1u);
  EXPECT_EQ(status.probes[0].name, "tip");
  EXPECT_EQ(status.probes[0].position, flexcast::test::position(world.simulation(), 10));
}

}  // namespace
}  // namespace flexcast::server
