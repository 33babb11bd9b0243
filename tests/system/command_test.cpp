// A command is acknowledged after its effect, with the step at which it took effect.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/system/recording.h"
#include "tests/system/replay.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

using CommandSystem = SystemTest;

constexpr std::size_t none = static_cast<std::size_t>(-1);

// The first step whose hashes differ.
std::size_t find_difference(const std::vector<std::uint64_t>& some, const std::vector<std::uint64_t>& others) {
  const auto [at, other] = std::mismatch(some.begin(), some.end(), others.begin(), others.end());
  return at == some.end() && other == others.end() ? none : static_cast<std::size_t>(at - some.begin());
}

// Frames after the change carry its revision, those up to its step the one before.
void expect_revision_from(const std::vector<FrameMessage>& frames, const client::Reply& reply) {
  for (const FrameMessage& frame : frames) {
    if (frame.step <= reply.applied_step) {
      EXPECT_LT(frame.parameter_revision, reply.parameter_revision) << "step " << frame.step;
    } else {
      EXPECT_GE(frame.parameter_revision, reply.parameter_revision) << "step " << frame.step;
    }
  }
}

// The recording alone says what happened: replayed with its events it gives its frames.
TEST_F(CommandSystem, ParameterChangesTakeEffectAtTheStepTheReplyNamesAndAtNoOther) {
  const auto scene = write_file("pair.toml", pair_scene());
  const auto server = start_server(scene, {"--paused", "--rate", "0.5"});
  auto connection = connect();
  const auto recorder = start_recorder("run.mcap");
  wait_for_frames(1);
  applied(connection.resume());
  const std::vector<std::vector<client::Parameter>> batches = {
      {{"rope.stiffness", 20.0}, {"beam.young", 5e4}},
      {{"gravity", client::Vector{1.0, 0.0, -3.0}}, {"time.integrator", "velocity_verlet"}},
      {{"time.step", 0.002}, {"time.substeps", std::int64_t{2}}},
  };
  std::vector<client::Reply> replies;
  for (const auto& batch : batches) {
    wait_for_frames(replies.empty() ? 50 : replies.back().applied_step + 50);
    replies.push_back(applied(connection.set(batch)));
    EXPECT_EQ(replies.back().values, batch);
  }
  wait_for_frames(replies.back().applied_step + 50);
  EXPECT_EQ(end_recorder(*recorder)["gaps"], 0);

  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  expect_contiguous(recording.frames, 0);
  const auto events = recording.command_events(flexcast_COMMAND_SET);
  ASSERT_EQ(events.size(), replies.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].step, replies[i].applied_step);
    EXPECT_EQ(events[i].time, replies[i].time);
    EXPECT_EQ(events[i].time, recording.frames[events[i].step].time);
    EXPECT_EQ(events[i].parameter_revision, replies[i].parameter_revision);
    EXPECT_EQ(events[i].client_id, connection.client_id());
    expect_revision_from(recording.frames, replies[i]);
  }

  auto changes = changes_of(events);
  const auto recorded = hashes_of(recording.frames);
  const auto steps = static_cast<std::int64_t>(recording.frames.back().step);
  EXPECT_EQ(find_difference(recorded, calc_hashes(scene, steps, changes)), none);
  for (Change& change : changes) {
    for (const int shift : {-1, 1}) {
      change.step += shift;
      const auto first = static_cast<std::size_t>(change.step + 1 - std::max(shift, 0));
      EXPECT_EQ(find_difference(recorded, calc_hashes(scene, steps, changes)), first) << change.values[0].name;
      change.step -= shift;
    }
  }
  const auto is_set = [](const auto& message) { return message.kind == flexcast_COMMAND_SET; };
  EXPECT_EQ(std::count_if(recording.commands.begin(), recording.commands.end(), is_set), 3);
  EXPECT_EQ(std::count_if(recording.replies.begin(), recording.replies.end(), is_set), 3);
}

// The numbers of all frames that come until the stream is silent for a while.
std::vector<std::uint64_t> drain(client::FrameStream& frames) {
  std::vector<std::uint64_t> numbers;
  while (const auto frame = frames.next(300ms)) numbers.push_back(frame->frame);
  return numbers;
}

TEST_F(CommandSystem, StepThreeWhilePausedGivesExactlyThreeFrames) {
  const auto server = start_server(write_file("rope.toml", rope_scene()), {"--rate", "0.2"});
  auto connection = connect();
  auto frames = connection.frames().value();
  ASSERT_TRUE(frames.next(patience));

  const Ended refused = ctl({"step", "3"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("wrong_state"), std::string::npos) << refused.err;

  const Json paused = ctl_json({"pause"});
  EXPECT_EQ(paused["state"], "paused");
  const auto at = paused["applied_step"].get<std::uint64_t>();
  const auto before = drain(frames);
  ASSERT_FALSE(before.empty());
  EXPECT_EQ(before.back(), at);

  const Json stepped = ctl_json({"step", "3"});
  EXPECT_EQ(stepped["applied_step"], at + 3);
  EXPECT_EQ(stepped["state"], "paused");
  EXPECT_EQ(drain(frames), (std::vector{at + 1, at + 2, at + 3}));
  EXPECT_EQ(ctl_json({"status"})["state"], "paused");
  EXPECT_EQ(drain(frames), std::vector<std::uint64_t>());

  const Json resumed = ctl_json({"resume"});
  EXPECT_EQ(resumed["state"], "running");
  EXPECT_EQ(resumed["applied_step"], at + 3);
  const auto next = frames.next(patience);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->frame, at + 4);
  EXPECT_EQ(frames.missed(), 0U);
}

struct Refusal {
  Arguments assignments;
  std::string parameter;
  std::string allowed;  // a part of what the reason says of it
};

TEST_F(CommandSystem, WhatSetDoesNotAllowIsRefusedWithAReasonAndChangesNothing) {
  const auto server = start_server(write_file("rope.toml", rope_scene()), {"--paused"});
  const Json before = ctl_json({"get"});
  const std::vector<Refusal> refusals = {
      {{"rope.stifness=1"}, "rope.stifness", "not a parameter"},
      {{"rope.stiffness=soft"}, "rope.stiffness", "a number"},
      {{"rope.stiffness=nan"}, "rope.stiffness", ">= 0"},
      {{"rope.stiffness=inf"}, "rope.stiffness", ">= 0"},
      {{"rope.stiffness=-1"}, "rope.stiffness", ">= 0"},
      {{"time.step=0"}, "time.step", "> 0"},
      {{"time.substeps=1.5"}, "time.substeps", "an integer"},
      {{"time.integrator=leapfrog"}, "time.integrator", "symplectic_euler"},
      {{"gravity=[0, 0, nan]"}, "gravity", "finite"},
      {{"server.rate=-1"}, "server.rate", ">= 0"},
      {{"rope.stiffness=77", "gravity=[1, 1, 1]", "rope.damping=-1"}, "rope.damping", ">= 0"},
      {{"rope.stiffness=77", "server.rate=nan"}, "server.rate", ">= 0"},
      {{"server.rate=2", "rope.stiffness=nan"}, "rope.stiffness", ">= 0"},
  };
  for (const Refusal& refusal : refusals) {
    Arguments arguments = refusal.assignments;
    arguments.insert(arguments.begin(), "set");
    const Ended ended = ctl(arguments);
    EXPECT_EQ(ended.code, 1) << refusal.assignments.back();
    EXPECT_EQ(ended.out, "");
    EXPECT_NE(ended.err.find(refusal.parameter), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find(refusal.allowed), std::string::npos) << ended.err;
  }
  const Json after = ctl_json({"get"});
  EXPECT_EQ(after["values"], before["values"]);
  EXPECT_EQ(after["parameter_revision"], before["parameter_revision"]);
  EXPECT_EQ(ctl_json({"status"})["parameter_revision"], before["parameter_revision"]);

  const Json good = ctl_json({"set", "rope.stiffness=77", "gravity=[1, 1, 1]"});
  EXPECT_EQ(good["values"], Json::parse(R"({"rope.stiffness": 77.0, "gravity": [1.0, 1.0, 1.0]})"));
  EXPECT_GT(good["parameter_revision"], before["parameter_revision"]);
  EXPECT_EQ(ctl_json({"get", "rope.stiffness"})["values"]["rope.stiffness"], 77.0);
}

}  // namespace
}  // namespace flexcast::test
