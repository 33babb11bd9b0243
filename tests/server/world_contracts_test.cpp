// What a contract chooses is an event with the step from which it holds, so that events and scene determine the run.
#include <gtest/gtest.h>

#include "tests/server/worlds.h"

namespace flexcast::server {
namespace {

using namespace test;

std::vector<Event> choices(const TestWorld& world) {
  std::vector<Event> found;
  for (const Event& event : world.events()) {
    if (event.kind == EventKind::choice) found.push_back(event);
  }
  return found;
}

std::int64_t substeps_of(const Event& event) {
  for (const ParameterAssignment& value : event.values) {
    if (value.name == "time.substeps") return std::get<std::int64_t>(value.value);
  }
  return 0;
}

TEST(WorldContracts, AWorldWithoutContractChoosesNothing) {
  TestWorld world;
  world.run(20);
  EXPECT_TRUE(choices(world).empty());
}

TEST(WorldContracts, EveryStepWasTakenAsTheLastChoiceBeforeItSays) {
  TestWorld world;
  world.apply(set({{"time.tolerance", 1e-4}}));
  for (int i = 0; i < 60; ++i) {
    world.run(1);
    const std::vector<Event> events = choices(world);
    ASSERT_FALSE(events.empty());
    EXPECT_LT(events.back().step, world.step_now());
    EXPECT_EQ(substeps_of(events.back()), world.simulation().statistics().substeps) << "step " << i;
    EXPECT_NE(events.back().text.find("time.tolerance chose"), std::string::npos);
  }
  EXPECT_GT(choices(world).size(), 1u) << "the motion changes; so should the choice";
}

// The test's clock says a microsecond a step, so that a budget of a hundredth of a step allows ten times the substeps.
TEST(WorldContracts, ABudgetsChoiceIsAnEventAndHoldsFromThenOn) {
  TestWorld world;
  world.apply(set({{"time.budget", 0.01}}));
  const std::int64_t first = substeps_of(choices(world).back());
  world.run(20);
  const std::vector<Event> events = choices(world);
  ASSERT_GE(events.size(), 2u);
  EXPECT_GT(substeps_of(events.back()), first);
  EXPECT_EQ(world.simulation().choice().substeps, substeps_of(events.back()));
  EXPECT_NE(events.back().text.find("time.budget chose"), std::string::npos);
}

TEST(WorldContracts, ABudgetsRunIsDoneAgainByItsEvents) {
  TestWorld world;
  world.apply(set({{"time.budget", 0.01}}));
  world.run(40);
  const std::vector<Event> events = choices(world);
  const auto again = flexcast::test::make(rope_scene());
  ASSERT_TRUE(again->set_parameters(std::vector<ParameterAssignment>{{"time.budget", 0.01}}).ok());
  for (std::int64_t step = 0; step < 40; ++step) {
    for (const Event& event : events) {
      if (event.step == step) again->choose({static_cast<int>(substeps_of(event)), 0});
    }
    ASSERT_TRUE(again->step());
  }
  EXPECT_EQ(again->calc_state_hash(), world.simulation().calc_state_hash());
}

TEST(WorldContracts, ABudgetThatCannotBeKeptIsAWarningInTheStatus) {
  TestWorld world;
  world.apply(set({{"time.budget", 1e-6}}));  // a nanosecond
  world.run(40);
  const WorldStatus status = world->calc_status();
  ASSERT_FALSE(status.warnings.empty());
  EXPECT_NE(status.warnings.back().find("time.budget"), std::string::npos);
  world.apply(set({{"time.budget", 0.0}}));
  EXPECT_TRUE(world->calc_status().warnings.empty());
}

TEST(WorldContracts, TheStatusHasSubstepsAndErrorOfTheLastStep) {
  TestWorld world;
  world.apply(set({{"time.tolerance", 1e-4}}));
  world.run(10);
  const StepReport report = world->calc_status().report.report;
  EXPECT_EQ(report.statistics.substeps, world.simulation().statistics().substeps);
  ASSERT_TRUE(report.error_estimate.has_value());
  EXPECT_GT(*report.error_estimate, 0.0);
}

TEST(WorldContracts, ASecondContractIsRefusedAndTheFirstStays) {
  TestWorld world;
  world.apply(set({{"time.tolerance", 1e-4}}));
  const Reply reply = world.ask(set({{"time.budget", 0.5}}));
  EXPECT_EQ(reply.outcome, Outcome::rejected);
  EXPECT_NE(reply.reason.find("time.tolerance"), std::string::npos) << reply.reason;
  EXPECT_EQ(world.parameter("time.tolerance"), 1e-4);
  EXPECT_EQ(world.ask(set({{"time.tolerance", 0.0}, {"time.budget", 0.5}})).outcome, Outcome::applied);
}

}  // namespace
}  // namespace flexcast::server
