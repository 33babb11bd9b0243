// What loading another scene does to a world.
#include <gtest/gtest.h>

#include "tests/server/worlds.h"

namespace flexcast::server {
namespace {

using namespace test;

std::string long_rope() {
  return R"(name = "long"
[time]
step = 0.002
[[body]]
name = "line"
model = "mass_spring"
mesh = { shape = "rope", cells = [20], size = [1.0] }
springs = { stiffness = 10.0 }
mass = 0.01
)";
}

WorldOptions with_scenes() {
  WorldOptions options;
  options.load_scene = [](const std::string& name) -> Result<Scene> {
    if (name != "long") return Error{"there is no scene '" + name + "'"};
    return load_scene_text(long_rope());
  };
  return options;
}

TEST(WorldLoad, ReplacesTheSceneInANewRunWithANewTopology) {
  TestWorld world(with_scenes());
  world.apply(set({{"server.rate", 0.5}, {"rope.stiffness", 50.0}}));
  world.run(10);
  const auto run_before = world->run_id();
  const auto revision = world->calc_status().parameter_revision;
  const Command command = load_scene("long");
  const Reply reply = world.ask(command);
  ASSERT_EQ(reply.outcome, Outcome::applied) << reply.reason;
  EXPECT_GT(reply.run_id, run_before);
  EXPECT_EQ(reply.applied_step, 0);
  EXPECT_EQ(reply.state, WorldState::running);
  EXPECT_GT(reply.parameter_revision, revision);
  EXPECT_EQ(world->rate(), 1.0);
  EXPECT_EQ(world.simulation().model().particle_count(), 21);

  const RunStarted run = world.notices_of<RunStarted>().back();
  EXPECT_EQ(run.run_id, reply.run_id);
  EXPECT_EQ(run.topology_revision, 2u);
  EXPECT_EQ(run.time_step, 0.002);
  EXPECT_EQ(run.scene->name, "long");
  EXPECT_TRUE(run.scene->overrides.empty());
  const ParametersChanged parameters = world.notices_of<ParametersChanged>().back();
  EXPECT_EQ(parameters.run_id, reply.run_id);
  EXPECT_EQ(parameters.parameter_revision, reply.parameter_revision);
  EXPECT_TRUE(std::any_of(parameters.descriptors.begin(), parameters.descriptors.end(),
                          [](const auto& row) { return row.name == "line.stiffness"; }));
  const auto events = world.events();
  const auto loaded =
      std::find_if(events.begin(), events.end(), [&](const Event& e) { return e.run_id == run.run_id; });
  ASSERT_NE(loaded, events.end());
  EXPECT_EQ(loaded->index, 0u);
  EXPECT_EQ(loaded->command, CommandKind::load);
  EXPECT_EQ(loaded->name, "long");
  EXPECT_EQ(loaded->key.request_id, command.key.request_id);

  EXPECT_EQ(world.frames().back().frame, 0u);
  EXPECT_EQ(world.frames().back().topology_revision, 2u);
  EXPECT_EQ(world->calc_status().topology_revision, 2u);
  world.run(3);
  EXPECT_EQ(world.frames().back().frame, 3u);
  EXPECT_DOUBLE_EQ(world->simulation_state().time, 0.006);
}

TEST(WorldLoad, AResetThenStartsTheLoadedScene) {
  TestWorld world(with_scenes());
  world.apply(load_scene("long"));
  world.apply(set({{"line.stiffness", 20.0}}));
  world.run(3);
  world.apply(reset());
  EXPECT_EQ(world.parameter("line.stiffness"), 10.0);
  EXPECT_EQ(world.notices_of<RunStarted>().back().scene->name, "long");
  EXPECT_EQ(world.notices_of<RunStarted>().back().topology_revision, 2u);
}

TEST(WorldLoad, LeavesAStandingWorldStandingStartsAFailedOneAndAnswersTheOpenGoal) {
  TestWorld world(with_scenes());
  world.apply(pause());
  EXPECT_EQ(world.ask(load_scene("long")).state, WorldState::paused);
  const Command goal = step(100);
  world.apply(goal);
  world.run(10);
  EXPECT_EQ(world.ask(load_scene("long")).state, WorldState::paused);
  EXPECT_EQ(world.reply_to(goal).outcome, Outcome::wrong_state);
  world.apply(set({{"line.stiffness", 1e12}, {"gravity", Vec3(0, 0, 1)}}));
  world.apply(grab(20, Vec3(5, 0, 0)));
  world.apply(resume());
  world.run(1000);
  ASSERT_EQ(world->state(), WorldState::failed);
  EXPECT_EQ(world.ask(load_scene("long")).state, WorldState::running);
}

TEST(WorldLoad, ASceneThatCannotBeLoadedIsRefusedAndChangesNothing) {
  TestWorld world(with_scenes());
  world.run(5);
  const auto run = world->run_id();
  const Reply reply = world.ask(load_scene("nowhere"));
  EXPECT_EQ(reply.outcome, Outcome::rejected);
  EXPECT_EQ(reply.reason, "there is no scene 'nowhere'");
  EXPECT_EQ(world->run_id(), run);
  EXPECT_EQ(world.step_now(), 5);
  EXPECT_EQ(world->topology_revision(), 1u);
}

TEST(WorldLoad, WithoutAFolderOfScenesItIsUnsupported) {
  TestWorld world;
  const Reply reply = world.ask(load_scene("long"));
  EXPECT_EQ(reply.outcome, Outcome::unsupported);
  EXPECT_FALSE(reply.reason.empty());
}

}  // namespace
}  // namespace flexcast::server
