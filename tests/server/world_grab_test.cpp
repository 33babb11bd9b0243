// Particles that are pulled, handles that exert forces, and the parameters of handles and obstacles.
#include <gtest/gtest.h>


#include "tests/server/worlds.h"

namespace flexcast::server {
namespace {

using namespace test;

constexpr std::int64_t tip = 10;

// Without gravity and with drag, so that it comes to rest where it is pulled.
std::string still_rope() {
  std::string text = rope_scene();
  text.replace(text.find("[0, 0, -9.81]"), 13, "[0, 0, 0]");
  return text.insert(text.find("pin ="), "drag = 0.1\n");
}

TEST(WorldGrab, AGrabbedParticleComesToItsTargetAndAReleasedOneLetsGo) {
  RunIds run_ids;
  World world(load(still_rope()), {}, run_ids);
  const auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      world.take_step();
      world.settle(0.0);
    }
  };
  const auto place = [&] { return flexcast::test::position(world.simulation(), tip); };
  const Vec3 target(0.9, 0.3, 0.0);
  world.apply(grab(tip, target), Clock::now());
  ASSERT_EQ(world.take_replies().back().outcome, Outcome::applied);
  run(8000);
  EXPECT_LT((place() - target).norm(), 0.01);
  world.apply(grab(tip, Vec3(1.3, 0.0, 0.0)), Clock::now());  // stretches the rope
  run(8000);
  const double pulled = place().x();
  EXPECT_GT(pulled, 1.02);
  world.apply(release(tip), Clock::now());
  ASSERT_EQ(world.take_replies().back().outcome, Outcome::applied);
  EXPECT_TRUE(world.simulation().grabs().empty());
  run(8000);
  EXPECT_LT(place().x(), 1.005);
}

TEST(WorldGrab, TakesEffectInTheNextStepAlsoWhenTheWorldStands) {
  WorldOptions paused;
  paused.paused = true;
  TestWorld world(paused);
  const Reply reply = world.ask(grab(tip, Vec3(1.0, 5.0, 0.0), 10.0));
  EXPECT_EQ(reply.outcome, Outcome::applied);
  EXPECT_EQ(reply.applied_step, 0);
  EXPECT_EQ(reply.state, WorldState::paused);
  EXPECT_EQ(flexcast::test::position(world.simulation(), tip), Vec3(1, 0, 0));
  world.apply(step(1));
  world.run(10);
  EXPECT_GT(flexcast::test::velocity(world.simulation(), tip).y(), 0.0);
}

TEST(WorldGrab, GrabAndReleaseAreEventsWithWhatIsInForce) {
  TestWorld world;
  world.run(4);
  world.apply(grab(tip, Vec3(1, 2, 3)));
  world.run(2);
  const Command command = release(tip);
  world.apply(command);
  std::vector<Event> events;
  for (const Event& event : world.events()) {
    if (event.kind == EventKind::command) events.push_back(event);
  }
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].command, CommandKind::grab);
  EXPECT_EQ(events[0].step, 4);
  EXPECT_EQ(events[0].particle, tip);
  EXPECT_EQ(events[0].target, Vec3(1, 2, 3));
  EXPECT_GT(events[0].stiffness, 0.0) << "the chosen one";
  EXPECT_EQ(events[1].command, CommandKind::release);
  EXPECT_EQ(events[1].step, 6);
  EXPECT_EQ(events[1].particle, tip);
  EXPECT_EQ(events[1].key.request_id, command.key.request_id);
}

TEST(WorldGrab, WhatCannotBeGrabbedOrReleasedIsRefusedAndChangesNothing) {
  TestWorld world;
  const std::vector<std::pair<Command, std::string>> refusals = {
      {grab(11, Vec3::Zero()), "there is no particle 11"},
      {grab(0, Vec3::Zero()), "held"},
      {grab(tip, Vec3(nan, 0, 0)), "target"},
      {grab(tip, Vec3::Zero(), -1.0), "stiffness"},
      {grab(tip, Vec3::Zero(), nan), "stiffness"},
      {release(tip), "not grabbed"},
      {release(11), "not grabbed"},
  };
  for (const auto& [command, part] : refusals) {
    const Reply reply = world.ask(command);
    EXPECT_EQ(reply.outcome, Outcome::rejected) << part;
    EXPECT_NE(reply.reason.find(part), std::string::npos) << reply.reason;
  }
  EXPECT_TRUE(world.simulation().grabs().empty());
  for (const Event& event : world.events()) EXPECT_NE(event.kind, EventKind::command);
}

TEST(WorldGrab, AStiffnessThatIsTooMuchForTheStepIsWarnedOf) {
  TestWorld world;
  world.apply(grab(tip, Vec3(1, 0, 0)));
  EXPECT_TRUE(world->calc_status().warnings.empty()) << "the chosen stiffness is within the limit";
  world.apply(grab(tip, Vec3(1, 0, 0), 1e6));
  EXPECT_FALSE(world->calc_status().warnings.empty());
  EXPECT_EQ(world.events().back().kind, EventKind::warning);
  world.apply(release(tip));
  EXPECT_TRUE(world->calc_status().warnings.empty());
}

TEST(WorldGrab, AResetLetsGo) {
  TestWorld world;
  world.apply(grab(tip, Vec3(1, 2, 3)));
  world.apply(reset());
  EXPECT_EQ(world.ask(release(tip)).outcome, Outcome::rejected);
}

// ---------------------------------------------------------------- handles, obstacles

std::string with_handle() {
  std::string text = rope_scene(R"([[contact]]
name = "ground"
shape = "plane"
point = [0, 0, -5]
normal = [0, 0, 1]
)");
  const std::string pin = "pin = [ { select = { nodes = [0] } } ]";
  return text.replace(text.find(pin), pin.size(), R"(handle = [ { name = "grip", select = { nodes = [0] } } ])");
}

TEST(WorldHandles, StatusShowsWhatAHandleExerts) {
  RunIds run_ids;
  const World world(load(with_handle()), {}, run_ids);
  const auto handles = world.calc_status().handles;
  ASSERT_EQ(handles.size(), 1u);
  EXPECT_EQ(handles[0].name, "grip");
  // The rope is not stretched yet: the handle carries its own particle.
  EXPECT_NEAR(handles[0].force.z(), 0.01 * 9.81, 1e-12);
}

TEST(WorldHandles, ParametersOfHandlesAndObstaclesAreDescribedSetAndReset) {
  RunIds run_ids;
  World world(load(with_handle()), {}, run_ids);
  const auto ask = [&](const Command& command) {
    world.apply(command, Clock::now());
    return world.take_replies().back();
  };
  const Reply described = ask(make_command(CommandKind::describe, DescribeCommand{}));
  for (const std::string name : {"contact.ground.friction", "contact.ground.point", "handle.grip.translate"}) {
    EXPECT_TRUE(std::any_of(described.descriptors.begin(), described.descriptors.end(), [&](const auto& row) {
      return row.name == name;
    })) << name;
  }
  const Reply reply = ask(set({{"handle.grip.translate", Vec3(0, 0, 1)}, {"contact.ground.friction", 0.5}}));
  ASSERT_EQ(reply.outcome, Outcome::applied) << reply.reason;
  EXPECT_EQ(reply.values[0].value, ParameterValue(Vec3(0, 0, 1)));
  EXPECT_EQ(reply.values[1].value, ParameterValue(0.5));
  EXPECT_EQ(ask(set({{"contact.ground.normal", Vec3(0, 0, 0)}})).outcome, Outcome::rejected);
  ask(reset());
  const Reply now = ask(make_command(CommandKind::get, GetCommand{{"handle.grip.translate"}}));
  EXPECT_EQ(now.values[0].value, ParameterValue(Vec3(0, 0, 0)));
}

}  // namespace
}  // namespace flexcast::server
