// Programs come and go; the others carry on, and what was recorded is whole.
#include <gtest/gtest.h>

#include "tests/system/recording.h"
#include "tests/system/replay.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

using LifeSystem = SystemTest;

TEST_F(LifeSystem, RecorderCarriesOnWithASecondRunWhenItsServerIsKilledAndStartedAgain) {
  const auto scene = write_file("rope.toml", rope_scene());
  auto server = start_server(scene, {"--rate", "0.3"});
  const auto recorder = start_recorder("run.mcap");
  std::uint64_t first_run = 0;
  wait_for_recorder([&](const flexcast_RecorderInfo& info) {
    first_run = info.run_id;
    return info.frames > 100;
  });
  server->send(SIGKILL);
  EXPECT_EQ(server->wait(patience), 128 + SIGKILL);
  server = start_server(scene, {"--rate", "0.3"});
  wait_for_recorder([&](const auto& info) { return info.run_id != first_run && info.next_frame > 100; });
  const Json summary = end_recorder(*recorder);
  EXPECT_EQ(summary["gaps"], 0);
  ASSERT_EQ(summary["runs"].size(), 2U);

  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  const auto runs = recording.run_ids();
  ASSERT_EQ(runs.size(), 2U);
  const auto truth = calc_hashes(scene, 2000);
  for (const std::uint64_t run : runs) {
    const auto frames = recording.frames_of(run);
    EXPECT_GT(frames.size(), 50U);
    expect_contiguous(frames, frames[0].frame);
    for (const FrameMessage& frame : frames) {
      if (frame.step >= truth.size()) break;
      ASSERT_EQ(frame.state_hash, truth[frame.step]);
    }
  }
  EXPECT_EQ(recording.scenes.size(), 2U);
  EXPECT_EQ(recording.attachments.size(), 1U);
}

TEST_F(LifeSystem, KilledRecorderLeavesAFileThatReadsUpToItsLastChunk) {
  const auto scene = write_file("rope.toml", rope_scene());
  const auto server = start_server(scene, {"--rate", "0.3"});
  const auto recorder = start_recorder("run.mcap");
  wait_for_frames(200);
  recorder->send(SIGKILL);
  EXPECT_EQ(recorder->wait(patience), 128 + SIGKILL);
  const Recording recording = read_recording(path("run.mcap"));
  EXPECT_EQ(recording.end.ending, mcap::Ending::kTruncated) << recording.end.message;
  ASSERT_GT(recording.frames.size(), 50U);  // a chunk is closed four times a second
  expect_contiguous(recording.frames, recording.frames[0].frame);
  EXPECT_EQ(recording.scenes.size(), 1U);
  EXPECT_TRUE(server->runs());
}

TEST_F(LifeSystem, SecondServerOfTheSameWorldIsRefusedAndTheFirstGoesOn) {
  const auto scene = write_file("rope.toml", rope_scene());
  const auto first = start_server(scene);
  auto connection = connect();
  const auto id = wait_for_status(connection, [](const auto& status) { return status.report.step > 10; })->server_id;
  const Ended second = run("flexcast-server", {scene.string(), "--domain", std::to_string(domain())});
  EXPECT_EQ(second.code, 1);
  EXPECT_EQ(second.out, "");
  for (const std::string part : {"world 'rope'", "already", "--world"}) {
    EXPECT_NE(second.err.find(part), std::string::npos) << second.err;
  }
  const auto now = wait_for_status(connection, [](const auto&) { return true; });
  EXPECT_EQ(now->server_id, id);
  const auto later = wait_for_status(connection, [&](const auto& status) { return status.heartbeat > now->heartbeat; });
  EXPECT_GT(later->report.step, now->report.step);

  const auto other = start_server(scene, {"--world", "other"});  // another name is welcome
  EXPECT_EQ(ctl_json({"list"})["worlds"].size(), 2U);
}

class EndSystem : public SystemTest {
 protected:
  void expect_clean_end(int signal);
};

void EndSystem::expect_clean_end(int signal) {
  const auto server = start_server(write_file("rope.toml", rope_scene()), {"--rate", "0.3"});
  const auto recorder = start_recorder("run.mcap");
  wait_for_frames(100);
  end(*server, signal);
  ASSERT_TRUE(recorder->wait_for_line("has gone", patience));
  const Json summary = end_recorder(*recorder, signal);
  EXPECT_EQ(summary["gaps"], 0);

  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  EXPECT_EQ(recording.metadata.at("flexcast.recording").at("ended"), "stopped");
  EXPECT_EQ(recording.frames.size(), summary["frames"]);
  expect_contiguous(recording.frames, recording.frames[0].frame);
  ASSERT_FALSE(recording.statuses.empty());
  EXPECT_EQ(recording.statuses.back().step, recording.frames.back().step);  // the last word of the server
}

TEST_F(EndSystem, ServerAndRecorderEndCleanlyOnSigintWithALastStatusAndACompleteFile) {
  expect_clean_end(SIGINT);
}

TEST_F(EndSystem, ServerAndRecorderEndCleanlyOnSigtermWithALastStatusAndACompleteFile) {
  expect_clean_end(SIGTERM);
}

TEST_F(LifeSystem, ServerEndsByItselfAtTheEndItWasGiven) {
  const auto scene = write_file("rope.toml", rope_scene());
  const Ended fast = run("flexcast-server", {scene.string(), "--domain", std::to_string(domain()), "--rate", "max",
                                             "--until", "0.5", "--exit", "--set", "rope.stiffness=20"});
  EXPECT_EQ(fast.code, 0) << fast.err;
  EXPECT_NE(fast.err.find("step 500:"), std::string::npos) << fast.err;

  // A recorder that waited for the world gets it to the last step, with the value that was set.
  const auto recorder = start_waiting_recorder("run.mcap", {"--wait", "60"});
  const auto server = start_server(scene, {"--until", "0.5", "--rate", "0.2", "--exit", "--set", "rope.stiffness=20"});
  EXPECT_EQ(server->wait(patience), 0);
  ASSERT_TRUE(recorder->wait_for_line("has gone", patience));
  EXPECT_EQ(end_recorder(*recorder)["gaps"], 0);
  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  const auto truth = calc_hashes(scene, 500, {{0, {{"rope.stiffness", 20.0}}}});
  EXPECT_EQ(recording.frames.back().step, 500U);
  for (const FrameMessage& frame : recording.frames) ASSERT_EQ(frame.state_hash, truth[frame.step]);
  EXPECT_EQ(recording.statuses.back().state, flexcast_WORLD_FINISHED);
}

// Stopped for so long that neither the sockets nor the server's history hold what it misses (20 KB a frame).
TEST_F(LifeSystem, StoppedRecorderDoesNotStopTheServerAndCountsWhatItMissed) {
  const auto server = start_server(write_file("sheet.toml", sheet_scene(40)), {"--rate", "0.5"});
  auto connection = connect();
  const auto recorder = start_recorder("run.mcap");
  wait_for_frames(50);
  recorder->send(SIGSTOP);
  const auto stopped = wait_for_status(connection, [](const auto&) { return true; });
  const auto later =
      wait_for_status(connection, [&](const auto& status) { return status.report.step > stopped->report.step + 1000; });
  EXPECT_GT(later->heartbeat, stopped->heartbeat + 1000);
  EXPECT_EQ(later->state, flexcast_WORLD_RUNNING);
  EXPECT_EQ(later->frames_skipped, 0U);  // the publisher kept up, too
  recorder->send(SIGCONT);
  wait_for_recorder([&](const auto& info) { return info.next_frame > later->report.step + 100; });

  const Json summary = end_recorder(*recorder);
  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  const std::uint64_t span = recording.frames.back().frame - recording.frames.front().frame + 1;
  const std::uint64_t missing = span - recording.frames.size();
  EXPECT_GT(missing, 100U);
  EXPECT_EQ(summary["frames"], recording.frames.size());
  EXPECT_EQ(summary["gaps"], missing);
  EXPECT_EQ(summary["runs"].size(), 1U);
  EXPECT_EQ(recording.metadata.at("flexcast.gaps").at("missing"), std::to_string(missing));
  std::uint64_t named = 0;
  for (const Json& gap : summary["missing"]) {
    named += gap["last"].get<std::uint64_t>() - gap["first"].get<std::uint64_t>() + 1;
  }
  EXPECT_EQ(named, missing);
}

}  // namespace
}  // namespace flexcast::test
