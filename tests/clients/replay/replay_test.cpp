// A replay in this process, and what watchers see of it.
#include "clients/replay/replay.h"

#include <gtest/gtest.h>

#include "idl/wire/decode.h"
#include "tests/clients/replay/watcher.h"

namespace flexcast::replay {
namespace {

using namespace std::chrono_literals;
using flexcast::test::RecordingMaker;
using test::Arrived;
using test::eventually;
using test::Listener;

class ReplayTest : public testing::Test {
 protected:
  // Two runs: 12 frames and 3.
  void make_recording(std::uint32_t chunks = 1) {
    RecordingMaker maker(path_);
    maker.add_run(100, 12, chunks);
    maker.add_run(200, 3, chunks);
    maker.close();
  }

  std::unique_ptr<Replay> start_paused(double rate = 0.0) {
    return test::start({.file = path_, .rate = rate, .paused = true});
  }

  // Subscribed to the frames before anything else happens.
  void watch(const Replay&) {
    ASSERT_TRUE(eventually([&] { return frames_.reader().matched().current > 0 && !frames_.take().empty(); }));
  }

  std::vector<wire::FrameHead> heads() {
    std::vector<wire::FrameHead> heads;
    for (const Arrived& sample : frames_.take()) heads.push_back(wire::peek_frame_head(sample.bytes).value());
    return heads;
  }

  // Numbers of the frames of the newest run.
  std::vector<std::uint64_t> newest_numbers() {
    std::vector<std::uint64_t> numbers;
    const auto all = heads();
    for (const auto& head : all) {
      if (head.run_id != all.back().run_id) continue;
      if (numbers.empty() || head.frame > numbers.back()) numbers.push_back(head.frame);
    }
    return numbers;
  }

  const flexcast::test::TemporaryFolder folder_;
  const std::string path_ = folder_.path("run.mcap");
  const wire::Participant participant_ = flexcast::test::join_test_domain();
  Listener<flexcast_ParticleFrame> frames_{participant_};
};

TEST_F(ReplayTest, TheFirstPassPublishesEveryFrameByteForByte) {
  make_recording(2);
  const auto replay = start_paused();
  watch(*replay);
  auto connection = test::connect();
  frames_.clear();
  test::applied(connection.resume());
  ASSERT_TRUE(eventually([&] { return replay->ended() && frames_.take().size() >= 28; }));

  auto recording = recording::Recording::open(path_).value();
  std::vector<std::vector<std::byte>> recorded;
  while (const auto* message = recording.next()) {
    if (message->topic == wire::TopicId::frames) recorded.emplace_back(message->bytes.begin(), message->bytes.end());
  }
  recorded.erase(recorded.begin(), recorded.begin() + 2);  // was shown before we asked for more
  std::vector<std::vector<std::byte>> seen;
  for (const Arrived& sample : frames_.take()) seen.push_back(sample.bytes);
  std::sort(recorded.begin(), recorded.end());  // DDS knows no order across chunks
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, recorded);
}

TEST_F(ReplayTest, AStepShowsSoManyFramesAndIsAnsweredWhenTheyAreThere) {
  make_recording();
  const auto replay = start_paused();
  watch(*replay);
  auto connection = test::connect();
  const auto reply = test::applied(connection.step(5));
  EXPECT_EQ(reply.applied_step, 50U);
  EXPECT_EQ(reply.run_id, 100U);
  EXPECT_EQ(reply.state, flexcast_WORLD_PAUSED);
  EXPECT_EQ(reply.report.step, 50U);
  EXPECT_TRUE(eventually([&] { return newest_numbers() == std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5}; }));
  EXPECT_EQ(test::applied(connection.step(7)).run_id, 200U);  // on into the next run
}

TEST_F(ReplayTest, AStepBeyondTheEndIsAnsweredWrongStateAndTheReplayIsFinished) {
  make_recording();
  const auto replay = start_paused();
  auto connection = test::connect();
  const auto reply = connection.step(100).value();
  EXPECT_EQ(reply.outcome, flexcast_OUTCOME_WRONG_STATE);
  EXPECT_NE(reply.reason.find("ends at 0.2 s"), std::string::npos) << reply.reason;
  EXPECT_EQ(reply.state, flexcast_WORLD_FINISHED);
  EXPECT_EQ(connection.resume().value().outcome, flexcast_OUTCOME_WRONG_STATE);
  EXPECT_EQ(connection.step(1).value().outcome, flexcast_OUTCOME_WRONG_STATE);
}

TEST_F(ReplayTest, RunUntilPlaysToTheFirstFrameThere) {
  make_recording();
  const auto replay = start_paused();
  auto connection = test::connect();
  EXPECT_EQ(test::applied(connection.run_until(0.65)).applied_step, 70U);
  EXPECT_EQ(connection.run_until(0.3).value().outcome, flexcast_OUTCOME_REJECTED);
  EXPECT_EQ(connection.run_until(1e9).value().outcome, flexcast_OUTCOME_REJECTED);
  EXPECT_EQ(test::applied(connection.run_until(1.1)).applied_step, 110U);
}

TEST_F(ReplayTest, ASeekPublishesSceneTopologyAndParametersFirst) {
  make_recording();
  Listener<flexcast_SceneInfo> scenes(participant_);
  Listener<flexcast_Topology> topologies(participant_);
  Listener<flexcast_ParameterSet> parameters(participant_);
  const auto replay = start_paused();
  watch(*replay);
  auto connection = test::connect();
  ASSERT_TRUE(eventually(
      [&] { return !scenes.take().empty() && topologies.take().size() >= 2 && !parameters.take().empty(); }));
  scenes.clear();
  topologies.clear();
  parameters.clear();
  const auto reply = test::applied(connection.set({{"replay.time", 0.5}}));
  EXPECT_GT(reply.run_id, 200U);
  EXPECT_EQ(reply.applied_step, 50U);
  EXPECT_NEAR(std::get<double>(*reply.find("replay.time")), 0.5, 1e-12);
  ASSERT_TRUE(eventually([&] {
    return heads().back().run_id == reply.run_id && scenes.take().size() == 1 && topologies.take().size() == 2 &&
           parameters.take().size() == 1;
  }));
  const Arrived frame = frames_.take().back();
  EXPECT_EQ(wire::peek_frame_head(frame.bytes).value().frame, 0U);
  EXPECT_EQ(wire::peek_frame_head(frame.bytes).value().step, 50U);
  const auto expect_before = [&](const auto& decoded, const Arrived& arrived) {
    EXPECT_EQ(decoded->run_id, reply.run_id);
    EXPECT_LT(arrived.written, frame.written);
  };
  const Arrived &scene = scenes.take()[0], &set = parameters.take()[0];
  expect_before(wire::decode<flexcast_SceneInfo>(scene.bytes).value(), scene);
  expect_before(wire::decode<flexcast_ParameterSet>(set.bytes).value(), set);
  for (const Arrived& part : topologies.take()) {
    expect_before(wire::decode<flexcast_Topology>(part.bytes).value(), part);
  }
}

TEST_F(ReplayTest, FramesAfterASeekCountFromZeroAndGapsStay) {
  RecordingMaker maker(path_);
  maker.add_run(100, 4);
  for (const std::uint64_t number : {6, 7, 9}) maker.add_frame(100, number);
  maker.close();
  const auto replay = start_paused();
  watch(*replay);
  auto connection = test::connect();
  test::applied(connection.set({{"replay.time", 0.2}}));
  test::applied(connection.resume());
  EXPECT_TRUE(eventually([&] { return newest_numbers() == std::vector<std::uint64_t>{0, 1, 4, 5, 7}; }));
}

TEST_F(ReplayTest, FromBeginsANewRunThere) {
  make_recording();
  const auto replay = test::start({.file = path_, .rate = 0.0, .from = 0.3, .to = 0.5, .paused = true});
  watch(*replay);
  EXPECT_GT(heads().back().run_id, 200U);
  EXPECT_EQ(heads().back().step, 30U);
  EXPECT_EQ(heads().back().frame, 0U);
  auto connection = test::connect();
  test::applied(connection.resume());
  ASSERT_TRUE(eventually([&] { return replay->ended(); }));
  EXPECT_TRUE(eventually([&] { return newest_numbers() == std::vector<std::uint64_t>{0, 1, 2}; }));
  EXPECT_EQ(heads().back().step, 50U);
}

TEST_F(ReplayTest, EveryRoundOfALoopIsANewerRunFromZero) {
  make_recording();
  const auto replay = test::start({.file = path_, .rate = 20.0, .to = 0.1, .loop = true});
  std::vector<std::uint64_t> runs;
  ASSERT_TRUE(eventually([&] {
    runs.clear();
    for (const auto& head : heads()) {
      if (head.run_id > 200 && (runs.empty() || runs.back() != head.run_id)) runs.push_back(head.run_id);
    }
    return runs.size() >= 6;
  }));
  EXPECT_TRUE(std::is_sorted(runs.begin(), runs.end()));
  std::uint64_t run = 0;
  for (const auto& head : heads()) {
    if (head.run_id == runs.front() || head.run_id <= 200) continue;  // may have been joined amid it
    if (head.run_id != run) {
      EXPECT_EQ(head.frame, 0U);
    }
    run = head.run_id;
  }
}

TEST_F(ReplayTest, AResetBeginsFromTheStartWithItsOwnParameters) {
  make_recording();
  const auto replay = start_paused(0.5);
  auto connection = test::connect();
  test::applied(connection.set({{"replay.rate", 0.0}, {"replay.loop", true}}));
  test::applied(connection.step(3));
  const auto reset = test::applied(connection.reset());
  EXPECT_EQ(reset.applied_step, 0U);
  EXPECT_GT(reset.run_id, 200U);
  EXPECT_EQ(reset.state, flexcast_WORLD_PAUSED);
  const auto values = test::applied(connection.get());
  EXPECT_EQ(*values.find("replay.rate"), client::Value(0.5));
  EXPECT_EQ(*values.find("replay.loop"), client::Value(false));
  test::applied(connection.set({{"replay.rate", 2.0}}));
  test::applied(connection.reset(true));
  EXPECT_EQ(*test::applied(connection.get({"replay.rate"})).find("replay.rate"), client::Value(2.0));
}

TEST_F(ReplayTest, WhatItCannotDoIsRefusedWithAReason) {
  make_recording();
  const auto replay = start_paused();
  auto connection = test::connect();
  for (const auto& reply : {connection.save("here"), connection.restore("here"), connection.load("rope"),
                            connection.grab(0, {}), connection.release(0)}) {
    EXPECT_EQ(reply.value().outcome, flexcast_OUTCOME_UNSUPPORTED);
    EXPECT_NE(reply.value().reason.find("replay"), std::string::npos);
  }
  const std::vector<std::pair<client::Parameter, std::string>> refused = {
      {{"beam.young", 1.0}, "no parameter 'beam.young'"},
      {{"replay.rate", -1.0}, "replay.rate = -1"},
      {{"replay.time", 99.0}, "0 s to 1.1 s"},
      {{"replay.loop", 1.0}, "true or false"}};
  for (const auto& [parameter, part] : refused) {
    // All or nothing.
    const auto reply = connection.set({{"replay.rate", 3.0}, parameter}).value();
    EXPECT_EQ(reply.outcome, flexcast_OUTCOME_REJECTED) << parameter.name;
    EXPECT_NE(reply.reason.find(part), std::string::npos) << reply.reason;
  }
  EXPECT_EQ(*test::applied(connection.get()).find("replay.rate"), client::Value(0.0));
  const auto described = test::applied(connection.describe());
  ASSERT_EQ(described.descriptors.size(), 3U);
  EXPECT_EQ(described.descriptors[1].name, "replay.time");
  EXPECT_NEAR(described.descriptors[1].maximum, 1.1, 1e-12);
}

TEST_F(ReplayTest, ARepeatedRequestIsExecutedOnceAndAnsweredFromMemory) {
  make_recording();
  const auto replay = start_paused();
  test::connect();
  const auto replies = wire::Reader<flexcast_Reply>::create(participant_).value();
  const auto commands = wire::Writer<flexcast_Command>::create(participant_).value();
  ASSERT_TRUE(eventually([&] { return replies.matched().current > 0 && commands.matched().current > 0; }));
  wire::Owned<flexcast_Command> step;
  wire::set_string(step->world, "beam");
  wire::set_string(step->client_id, "me");
  step->request_id = 5;
  step->kind = flexcast_COMMAND_STEP;
  step->count = 2;
  for (int repetition = 0; repetition < 3; ++repetition) {
    ASSERT_TRUE(commands.write(*step).ok());
    ASSERT_TRUE(replies.wait(40s));
    const auto taken = replies.take();
    ASSERT_EQ(taken.value().size(), 1U);
    EXPECT_EQ(taken.value()[0].data.applied_step, 20U);
  }
}

TEST_F(ReplayTest, StatusesCarryTheRecordedReportUnderTheReplaysOwnState) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2);
  maker.add_status(100, 10, 4.5);
  maker.add_frame(100, 2);
  maker.close();
  const auto replay = start_paused(0.0);
  auto connection = test::connect();
  test::applied(connection.step(1));
  const auto before = connection.status().value();
  EXPECT_EQ(before->report.step, 10U);
  EXPECT_TRUE(std::isnan(before->report.kinetic));  // no status was recorded so far
  test::applied(connection.step(1));
  const auto after = connection.status().value();
  EXPECT_EQ(after->report.step, 20U);
  EXPECT_TRUE(std::isnan(after->report.kinetic));  // what was recorded is of an older step
  EXPECT_EQ(wire::text(after->version), "9.8.7");
  EXPECT_EQ(after->state, flexcast_WORLD_FINISHED);
  EXPECT_EQ(after->frames_published, 3U);
  EXPECT_NE(after->server_id, 7U);
  EXPECT_GT(after->heartbeat, before->heartbeat);
  EXPECT_LT(before->heartbeat, 1000U);

  // A status that tells of the frame that is shown keeps its numbers, also while the replay stands still.
  RecordingMaker again(path_);
  again.add_run(300, 2);
  again.add_status(300, 10, 4.5);
  again.close();
  const auto other = test::start({.file = path_, .world = "other"});
  auto second = test::connect("other");
  ASSERT_TRUE(eventually([&] { return other->ended(); }));
  for (int i = 0; i < 3; ++i) {
    const auto status = second.status().value();
    EXPECT_EQ(status->report.kinetic, 4.5);
    EXPECT_EQ(status->state, flexcast_WORLD_FINISHED);
  }
}

TEST_F(ReplayTest, ANameIsGivenToEveryMessageAndTheOldOneIsNotThere) {
  make_recording();
  Listener<flexcast_Event> events(participant_);
  const auto replay = test::start({.file = path_, .world = "again", .rate = 0.0});
  ASSERT_TRUE(eventually([&] { return replay->ended() && events.take().size() == 2; }));
  EXPECT_EQ(wire::text(wire::decode<flexcast_Event>(events.take()[0].bytes).value()->world), "again");
  for (const auto& head : heads()) EXPECT_EQ(head.world, "again");
  auto watch = wire::WorldWatch::create(participant_).value();
  EXPECT_TRUE(watch.wait_for("again", 40s));
  EXPECT_EQ(watch.find("beam"), nullptr);
}

TEST_F(ReplayTest, BodiesThatALoadedSceneDoesNotHaveAreDisposed) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2);
  wire::Owned<flexcast_SceneInfo> scene;
  wire::set_string(scene->world, "beam");
  scene->run_id = 200;
  scene->topology_revision = 2;
  wire::resize(scene->bodies, 1);
  maker.add(*scene);
  maker.add_frame(200, 0);
  maker.close();
  Listener<flexcast_Topology> topologies(participant_);
  const auto replay = start_paused();
  ASSERT_TRUE(eventually([&] { return topologies.take().size() == 2; }));
  EXPECT_FALSE(topologies.disposed());
  auto connection = test::connect();
  test::applied(connection.step(2));
  EXPECT_TRUE(eventually([&] { return topologies.take(), topologies.disposed(); }));
}

TEST_F(ReplayTest, AWorldOfThatNameIsRefused) {
  make_recording();
  const auto first = start_paused();
  const auto second = Replay::start({.file = path_, .domain = flexcast::test::test_domain(), .profile = "loopback"},
                                    {.say = [](const auto&) {}});
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().message.find("world 'beam' is on domain"), std::string::npos) << second.error().message;
}

TEST_F(ReplayTest, AtItsEndALateReaderGetsTheLastFrame) {
  make_recording(2);
  const auto replay = test::start({.file = path_, .rate = 0.0});
  ASSERT_TRUE(eventually([&] { return replay->ended(); }));
  Listener<flexcast_ParticleFrame> late(participant_);
  ASSERT_TRUE(eventually([&] { return late.take().size() >= 2; }));
  for (const Arrived& sample : late.take()) {
    const auto head = wire::peek_frame_head(sample.bytes).value();
    EXPECT_EQ(head.run_id, 200U);
    EXPECT_EQ(head.frame, 2U);
  }
}

TEST_F(ReplayTest, WhenItEndsItSaysGoodbye) {
  make_recording();
  Listener<flexcast_Status> statuses(participant_);
  const auto replay = start_paused();
  ASSERT_TRUE(eventually([&] { return !statuses.take().empty(); }));
  EXPECT_FALSE(statuses.disposed());
  replay->stop();
  EXPECT_TRUE(eventually([&] { return statuses.take(), statuses.disposed(); }));
}

TEST_F(ReplayTest, ATruncatedRecordingIsReplayedAsFarAsItGoesWithAWarning) {
  RecordingMaker maker(path_);
  maker.add_run(100, 4);
  maker.cut();
  std::string said;
  const auto replay =
      Replay::start({.file = path_, .domain = flexcast::test::test_domain(), .profile = "loopback", .rate = 0.0},
                    {.say = [&](const std::string& line) { said += line; }});
  ASSERT_TRUE(replay.ok());
  EXPECT_NE(said.find("truncated"), std::string::npos) << said;
  ASSERT_TRUE(eventually([&] { return replay.value()->ended(); }));
  EXPECT_EQ(replay.value()->latest().shown.frame, 3U);
}

}  // namespace
}  // namespace flexcast::replay
