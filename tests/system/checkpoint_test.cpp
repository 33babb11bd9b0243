// Checkpoints, scenes and grabs, through the real programs.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/system/recording.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

class CheckpointSystem : public SystemTest {
 protected:
  Arguments checkpoints(Arguments arguments = {}) const {
    arguments.insert(arguments.end(), {"--checkpoints", path("saved").string()});
    return arguments;
  }

  // Takes `steps` steps of a standing world; their hashes. The newest frame may have come before or come again.
  static std::vector<std::uint64_t> step_hashes(client::Connection& connection, client::FrameStream& frames,
                                                std::uint64_t steps) {
    const auto reply = applied(connection.step(steps, patience));
    std::vector<std::uint64_t> hashes;
    while (const auto frame = frames.next(patience)) {
      if (frame->run_id != reply.run_id || frame->step + steps <= reply.applied_step) continue;
      hashes.push_back(frame->state_hash);
      if (frame->step == reply.applied_step) return hashes;
    }
    throw std::runtime_error("frames are missing");
  }
};

TEST_F(CheckpointSystem, ARestoredWorldRepeatsItsFramesBitForBitAlsoAfterARestartOfTheServer) {
  const auto scene = write_file("pair.toml", pair_scene());
  std::vector<std::uint64_t> truth;
  {
    const auto server = start_server(scene, checkpoints({"--paused"}));
    auto connection = connect();
    auto frames = connection.frames().value();
    applied(connection.set({{"rope.stiffness", 70.0}}));
    ctl_json({"step", "40"});
    applied(connection.grab(20, {0.5, 0.5, 0.5}));
    EXPECT_EQ(ctl_json({"save", "start"})["applied_step"], 40);
    EXPECT_TRUE(std::filesystem::exists(path("saved") / "pair" / "start.checkpoint"));
    truth = step_hashes(connection, frames, 60);
    ASSERT_EQ(truth.size(), 60U);

    applied(connection.set({{"gravity", client::Vector{0, 0, 5}}, {"time.integrator", "velocity_verlet"}}));
    ctl_json({"step", "10"});
    const auto last = frames.wait_for_frame([](const client::Frame& frame) { return frame.step == 110; }, patience);
    ASSERT_TRUE(last) << last.error().message;
    const Json restored = ctl_json({"restore", "start"});
    EXPECT_EQ(restored["applied_step"], 40);
    EXPECT_EQ(restored["state"], "paused");
    EXPECT_EQ(restored["run_id"], last.value().run_id);
    const auto shown = frames.next(patience);
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->frame, last.value().frame + 1);
    EXPECT_EQ(shown->step, 40U);
    EXPECT_EQ(step_hashes(connection, frames, 60), truth);
    EXPECT_EQ(frames.missed(), 0U);
    end(*server, SIGTERM);
  }
  const auto server = start_server(scene, checkpoints({"--paused"}));
  auto connection = connect();
  auto frames = connection.frames().value();
  EXPECT_EQ(ctl_json({"restore", "start"})["applied_step"], 40);
  EXPECT_EQ(ctl_json({"get", "rope.stiffness"})["values"]["rope.stiffness"], 70.0);
  EXPECT_EQ(step_hashes(connection, frames, 60), truth);

  const Ended missing = ctl({"restore", "end"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.err.find("end.checkpoint"), std::string::npos) << missing.err;
  EXPECT_EQ(ctl_json({"status"})["step"], 100);
}

TEST_F(CheckpointSystem, ARecorderHasEveryFrameAndEventAroundARestore) {
  const auto server = start_server(write_file("rope.toml", rope_scene()), checkpoints({"--paused", "--rate", "0.5"}));
  auto connection = connect();
  const auto recorder = start_recorder("run.mcap");
  wait_for_frames(1);
  applied(connection.save("start"));
  applied(connection.resume());
  wait_for_frames(100);
  const auto restored = applied(connection.restore("start"));
  EXPECT_EQ(restored.state, flexcast_WORLD_RUNNING);
  wait_for_frames(200);
  end(*server, SIGTERM);
  const Json summary = end_recorder(*recorder);
  EXPECT_EQ(summary["gaps"], 0);

  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  ASSERT_EQ(recording.run_ids().size(), 1U);
  expect_contiguous(recording.frames, 0);
  const auto& frames = recording.frames;
  const auto back =
      std::adjacent_find(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return b.step <= a.step; });
  ASSERT_NE(back, frames.end());
  ASSERT_EQ((back + 1)->step, 0U);
  for (auto first = frames.begin(), again = back + 1; first != back + 1 && again != frames.end(); ++first, ++again) {
    ASSERT_EQ(again->state_hash, first->state_hash) << "step " << first->step;
  }
  ASSERT_EQ(recording.command_events(flexcast_COMMAND_SAVE).size(), 1U);
  const auto events = recording.command_events(flexcast_COMMAND_RESTORE);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].name, "start");
  EXPECT_EQ(events[0].step, 0U);
}

TEST_F(CheckpointSystem, AGrabbedParticleComesToItsTargetAndAReleasedOneLetsGo) {
  std::string text = rope_scene();
  text.insert(text.find("pin ="), "drag = 0.2\n");
  const auto server = start_server(write_file("rope.toml", text), {"--rate", "max", "--paused"});
  const auto tip = [&](double time) {
    ctl_json({"run-until", std::to_string(time)});
    const Json status = ctl_json({"status"});
    EXPECT_EQ(status["time"], time);
    return status["probes"]["end"]["position"].get<std::vector<double>>();
  };
  const auto hanging = tip(20);
  ctl_json({"grab", "10", "0.6", "-0.3", "-0.2", "--stiffness", "500"});
  const auto pulled = tip(40);
  EXPECT_NEAR(pulled[0], 0.6, 0.02);
  EXPECT_NEAR(pulled[1], -0.3, 0.02);
  EXPECT_NEAR(pulled[2], -0.2, 0.02);
  ctl_json({"release", "10"});
  const auto again = tip(60);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(again[i], hanging[i], 0.02);
  const Ended twice = ctl({"release", "10"});
  EXPECT_EQ(twice.code, 1);
  EXPECT_NE(twice.err.find("not grabbed"), std::string::npos) << twice.err;
}

TEST_F(CheckpointSystem, AnotherSceneOfTheFolderIsLoadedInTheSameWorld) {
  write_file("scenes/rope.toml", rope_scene());
  const auto server =
      start_server(write_file("scenes/pair.toml", pair_scene()), {"--paused", "--set", "rope.stiffness=20"});
  const auto recorder = start_recorder("run.mcap");
  wait_for_frames(1);
  const Json loaded = ctl_json({"load", "rope"});
  EXPECT_EQ(loaded["applied_step"], 0);
  EXPECT_EQ(ctl_json({"get", "rope.stiffness"})["values"]["rope.stiffness"], 50.0) << "--set is of the first scene";
  EXPECT_EQ(ctl_json({"--world", "pair", "step", "20"})["run_id"], loaded["run_id"]);
  const Ended missing = ctl({"load", "cloth"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.err.find("cloth.toml"), std::string::npos) << missing.err;
  wait_for_frames(1 + 21);
  end(*server, SIGTERM);
  EXPECT_EQ(end_recorder(*recorder)["gaps"], 0);

  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  ASSERT_EQ(recording.run_ids().size(), 2U);
  const auto frames = recording.frames_of(loaded["run_id"]);
  expect_contiguous(frames, 0);
  EXPECT_EQ(frames.back().total, 11U);
  ASSERT_EQ(recording.scenes.size(), 2U);
  const SceneMessage& scene = recording.scenes[1];
  EXPECT_EQ(scene.world, "pair");
  EXPECT_EQ(scene.name, "rope");
  EXPECT_TRUE(scene.overrides.empty());
  EXPECT_EQ(scene.topology_revision, 2U);
  EXPECT_EQ(frames.front().topology_revision, 2U);
  EXPECT_EQ(recording.command_events(flexcast_COMMAND_LOAD).at(0).name, "rope");
}

}  // namespace
}  // namespace flexcast::test
