// What save and restore do to a world.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/server/worlds.h"

namespace flexcast::server {
namespace {

using namespace test;

class WorldCheckpoints : public testing::Test {
 protected:
  WorldOptions options(bool paused = false) const {
    WorldOptions options;
    options.paused = paused;
    options.checkpoints = path();
    return options;
  }
  std::filesystem::path path() const { return folder_.path() / "checkpoints" / "rope"; }
  std::filesystem::path file(const std::string& name) const { return path() / (name + ".checkpoint"); }

 private:
  Folder folder_;
};

std::vector<std::uint64_t> run_hashes(TestWorld& world, int steps) {
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < steps; ++i) {
    world.run(1);
    hashes.push_back(world.simulation().calc_state_hash());
  }
  return hashes;
}

// The events that commands have made, the last first.
std::vector<Event> command_events(const TestWorld& world) {
  std::vector<Event> events;
  for (const Event& event : world.events()) {
    if (event.kind == EventKind::command) events.insert(events.begin(), event);
  }
  return events;
}

TEST_F(WorldCheckpoints, ARestoredWorldGoesOnToTheLastBitAsTheSavedOneDid) {
  TestWorld world(options());
  world.apply(set({{"rope.stiffness", 80.0}}));
  world.run(20);
  const Reply saved = world.ask(save("start"));
  ASSERT_EQ(saved.outcome, Outcome::applied) << saved.reason;
  EXPECT_EQ(saved.applied_step, 20);
  const auto before = run_hashes(world, 30);
  world.apply(set({{"rope.stiffness", 60.0}}));
  world.run(5);
  const Reply restored = world.ask(restore("start"));
  ASSERT_EQ(restored.outcome, Outcome::applied) << restored.reason;
  EXPECT_EQ(restored.applied_step, 20);
  EXPECT_DOUBLE_EQ(restored.time, 0.02);
  EXPECT_EQ(world.parameter("rope.stiffness"), 80.0);
  EXPECT_EQ(run_hashes(world, 30), before);
}

TEST_F(WorldCheckpoints, AnotherServerOfTheSceneRestoresWhatTheFirstSaved) {
  std::vector<std::uint64_t> before;
  {
    TestWorld world(options());
    world.run(20);
    world.apply(save("start"));
    before = run_hashes(world, 30);
  }
  TestWorld world(options(true));
  EXPECT_EQ(world.ask(restore("start")).applied_step, 20);
  world.apply(resume());
  EXPECT_EQ(run_hashes(world, 30), before);
}

TEST_F(WorldCheckpoints, TheRestoredStateIsAFrameAndFramesAreNumberedOnWithinTheRun) {
  TestWorld world(options());
  world.run(10);
  world.apply(save("start"));
  world.run(7);
  const auto revision = world.ask(restore("start")).parameter_revision;
  world.run(3);
  const auto& frames = world.frames();
  ASSERT_EQ(frames.size(), 18u + 1u + 3u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].frame, i);
    EXPECT_EQ(frames[i].run_id, frames[0].run_id);
    EXPECT_EQ(frames[i].step, static_cast<std::int64_t>(i < 18 ? i : i - 8));
  }
  EXPECT_EQ(frames[18].parameter_revision, revision);
  EXPECT_GT(revision, frames[17].parameter_revision);
}

TEST_F(WorldCheckpoints, TheRestoredStateIsAFrameAlsoBetweenPublishedSteps) {
  TestWorld world(options(), "[stream]\nevery = 4\n");
  world.run(5);
  world.apply(save("start"));
  world.run(1);
  world.apply(restore("start"));
  EXPECT_EQ(world.frames().back().step, 5);
  EXPECT_EQ(world.frames().back().frame, 2u);
}

TEST_F(WorldCheckpoints, BothAreEventsWithTheName) {
  TestWorld world(options());
  world.run(10);
  world.apply(save("start"));
  world.run(5);
  const Command command = restore("start");
  world.apply(command);
  const auto events = command_events(world);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].command, CommandKind::save);
  EXPECT_EQ(events[1].name, "start");
  EXPECT_EQ(events[1].step, 10);
  EXPECT_EQ(events[0].command, CommandKind::restore);
  EXPECT_EQ(events[0].name, "start");
  EXPECT_EQ(events[0].step, 10);
  ASSERT_EQ(events[0].values.size(), 1u);
  EXPECT_EQ(events[0].values[0].name, "left_step");
  EXPECT_EQ(events[0].values[0].value, ParameterValue(std::int64_t{15}));
  EXPECT_EQ(events[0].key.request_id, command.key.request_id);
  EXPECT_EQ(events[0].index, world.events().back().index);
  EXPECT_EQ(world.notices_of<RunStarted>().size(), 1u);
  const auto parameters = world.notices_of<ParametersChanged>();
  EXPECT_EQ(parameters.back().step, 10);
  EXPECT_EQ(parameters.back().parameter_revision, events[0].parameter_revision);
}

TEST_F(WorldCheckpoints, ARunningWorldRunsOnAndAStandingOneStands) {
  TestWorld world(options());
  world.apply(save("start"));
  EXPECT_EQ(world.ask(restore("start")).state, WorldState::running);
  world.apply(pause());
  EXPECT_EQ(world.ask(save("start")).state, WorldState::paused);
  EXPECT_EQ(world.ask(restore("start")).state, WorldState::paused);
}

TEST_F(WorldCheckpoints, ARestoreAnswersTheOpenGoalAndPauses) {
  TestWorld world(options());
  world.run(10);
  world.apply(save("start"));
  const Command goal = run_until(1.0);
  world.apply(goal);
  world.run(5);
  EXPECT_EQ(world.ask(restore("start")).state, WorldState::paused);
  EXPECT_EQ(world.reply_to(goal).outcome, Outcome::wrong_state);
  EXPECT_NE(world.reply_to(goal).reason.find("restored"), std::string::npos);
  EXPECT_EQ(world.events().back().state, WorldState::paused);
}

TEST_F(WorldCheckpoints, AFailedWorldCanBeSavedAndIsPausedWhenRestored) {
  TestWorld world(options());
  world.run(10);
  world.apply(save("good"));
  world.apply(set_explosive());
  world.run(1000);
  ASSERT_EQ(world->state(), WorldState::failed);
  const auto last_good = world.step_now();
  const Reply saved = world.ask(save("failed"));
  EXPECT_EQ(saved.outcome, Outcome::applied) << saved.reason;
  EXPECT_EQ(saved.applied_step, last_good);
  EXPECT_EQ(saved.state, WorldState::failed);
  const Reply good = world.ask(restore("good"));
  EXPECT_EQ(good.outcome, Outcome::applied) << good.reason;
  EXPECT_EQ(good.state, WorldState::paused);
  EXPECT_FALSE(world->calc_status().failure.has_value());
  EXPECT_TRUE(world->calc_status().warnings.empty());
  EXPECT_EQ(world.events().back().state, WorldState::paused);
  world.apply(resume());
  world.run(20);
  EXPECT_EQ(world.step_now(), 30);
  EXPECT_EQ(world.ask(restore("failed")).applied_step, last_good);
}

TEST_F(WorldCheckpoints, AFinishedWorldIsPausedBeforeItsEndWhichHoldsAgain) {
  WorldOptions until = options();
  until.until = 0.02;
  TestWorld world(until);
  world.run(10);
  world.apply(save("start"));
  world.run(1000);
  ASSERT_EQ(world->state(), WorldState::finished);
  world.apply(save("end"));
  EXPECT_EQ(world.ask(restore("start")).state, WorldState::paused);
  world.apply(resume());
  world.run(1000);
  EXPECT_EQ(world->state(), WorldState::finished);
  EXPECT_EQ(world.step_now(), 20);
  EXPECT_EQ(world.ask(restore("end")).state, WorldState::paused);
  world.apply(resume());
  world.run(5);
  EXPECT_EQ(world.step_now(), 25);
}

TEST_F(WorldCheckpoints, WhatCannotBeRestoredIsRefusedAndChangesNothing) {
  TestWorld world(options());
  world.run(10);
  world.apply(save("whole"));
  {
    TestWorld other(options(),
                    "[[body]]\nname = \"other\"\nmodel = \"mass_spring\"\nmass = 1.0\n"
                    "mesh = { shape = \"rope\", cells = [2], size = [1.0] }\n"
                    "springs = { stiffness = 1.0 }\n");
    other.apply(save("stale"));
  }
  std::ifstream whole(file("whole"), std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(whole)), {});
  std::ofstream(file("cut"), std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(file("damaged"), std::ios::binary) << bytes;
  world.run(5);
  const auto hash = world.simulation().calc_state_hash();
  const auto events = world.events().size();
  const auto frames = world.frames().size();
  const std::vector<std::pair<std::string, std::string>> refusals = {
      {"missing", "missing.checkpoint"}, {"stale", "another scene"}, {"cut", "cut short"}, {"damaged", "damaged"},
      {"../rope/whole", "not a name"},   {"", "not a name"}};
  for (const auto& [name, part] : refusals) {
    const Reply reply = world.ask(restore(name));
    EXPECT_EQ(reply.outcome, Outcome::rejected) << name;
    EXPECT_NE(reply.reason.find(part), std::string::npos) << reply.reason;
    EXPECT_EQ(reply.applied_step, 15);
    EXPECT_EQ(reply.parameter_revision, 1u);
    EXPECT_EQ(reply.state, WorldState::running);
  }
  EXPECT_EQ(world.simulation().calc_state_hash(), hash);
  EXPECT_EQ(world.events().size(), events);
  EXPECT_EQ(world.frames().size(), frames);
}

TEST_F(WorldCheckpoints, NamesThatAreNoFileNamesAreRefused) {
  TestWorld world(options());
  for (const std::string& name : {std::string(), std::string("a/b"), std::string(".."), std::string(65, 'a'),
                                  std::string("a b"), std::string("a.b"), std::string("a\0b", 3)}) {
    const Reply reply = world.ask(save(name));
    EXPECT_EQ(reply.outcome, Outcome::rejected) << name;
    EXPECT_NE(reply.reason.find("not a name"), std::string::npos) << reply.reason;
  }
  EXPECT_FALSE(std::filesystem::exists(path())) << "made only when needed";
  EXPECT_EQ(world.ask(save(std::string(64, 'a'))).outcome, Outcome::applied);
  EXPECT_TRUE(std::filesystem::exists(file(std::string(64, 'a'))));
}

TEST_F(WorldCheckpoints, WhatCannotBeWrittenIsRefusedWithTheReason) {
  std::ofstream(path().parent_path()) << "a file where the folder should be";
  TestWorld world(options());
  const Reply reply = world.ask(save("start"));
  EXPECT_EQ(reply.outcome, Outcome::rejected);
  EXPECT_NE(reply.reason.find(path().string()), std::string::npos) << reply.reason;
  EXPECT_TRUE(command_events(world).empty());
}

}  // namespace
}  // namespace flexcast::server
