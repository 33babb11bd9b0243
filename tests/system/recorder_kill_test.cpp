// Recorders that are killed at any moment leave a file that can be completed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <thread>

#include "tests/system/recording.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

using RecorderKill = SystemTest;

int kills() {
  return std::getenv("FLEXCAST_LONG") != nullptr ? 500 : 25;
}

// What was whole before is what there is afterwards. A busy machine may lose frames on the way: these are named.
void expect_same_frames(const Recording& before, const Recording& after, const Json& summary) {
  EXPECT_NE(before.end.ending, mcap::Ending::kDamaged) << before.end.message;
  expect_complete(after);
  ASSERT_EQ(after.frames.size(), before.frames.size());
  EXPECT_EQ(summary["frames"], after.frames.size());
  if (after.frames.empty()) return;
  const std::uint64_t numbers = after.frames.back().frame - after.frames.front().frame + 1;
  EXPECT_EQ(summary["gaps"], numbers - after.frames.size());
  for (std::size_t i = 0; i < after.frames.size(); ++i) {
    ASSERT_EQ(after.frames[i].state_hash, before.frames[i].state_hash);
  }
}

TEST_F(RecorderKill, AtAnyMomentLeavesARecordingThatCanBeCompletedWithEveryWholeChunk) {
  constexpr int at_once = 5;  // recorders
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--rate", "0.5"});
  std::mt19937 random(23);
  std::size_t frames = 0;
  for (int killed = 0; killed < kills();) {
    std::vector<std::unique_ptr<Process>> recorders;
    for (int i = 0; i < at_once; ++i) {
      recorders.push_back(start_waiting_recorder("run" + std::to_string(i) + ".mcap", {"--force"}));
    }
    for (const auto& recorder : recorders) ASSERT_TRUE(recorder->wait_for_line("recording:", patience));
    for (int i = 0; i < at_once; ++i, ++killed) {
      std::this_thread::sleep_for(std::chrono::milliseconds(random() % 200));
      recorders[static_cast<std::size_t>(i)]->send(SIGKILL);
      ASSERT_EQ(recorders[static_cast<std::size_t>(i)]->wait(patience), 128 + SIGKILL);
      const auto file = path("run" + std::to_string(i) + ".mcap");
      const Recording before = read_recording(file);
      const Ended recovered = run("flexcast-record", {"--recover", file.string(), "--json"});
      ASSERT_EQ(recovered.code, 0) << recovered.err;
      expect_same_frames(before, read_recording(file), Json::parse(recovered.out));
      frames += before.frames.size();
    }
  }
  EXPECT_GT(frames, 0U) << "no recorder lived long enough to say anything";
}

// What came while it was paused is in no message: the recorder has said so as it went.
TEST_F(RecorderKill, WhilePausedLeavesAFileThatKnowsOfThePause) {
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--rate", "0.5"});
  const auto recorder = start_waiting_recorder("run.mcap", {"--paused"});
  ASSERT_TRUE(recorder->wait_for_line("paused:", patience));
  for (const client::Deadline deadline(patience); !deadline.passed();) {
    std::filesystem::copy_file(path("run.mcap"), path("copy.mcap"), std::filesystem::copy_options::overwrite_existing);
    const Ended now = run("flexcast-record", {"--recover", path("copy.mcap").string(), "--json"});
    if (now.code == 0 && Json::parse(now.out)["paused_frames"] > 50) break;
  }
  recorder->send(SIGKILL);
  ASSERT_EQ(recorder->wait(patience), 128 + SIGKILL);
  const Ended recovered = run("flexcast-record", {"--recover", path("run.mcap").string(), "--json"});
  ASSERT_EQ(recovered.code, 0) << recovered.err;
  const Json summary = Json::parse(recovered.out);
  EXPECT_GT(summary["paused_frames"], 50);
  EXPECT_EQ(summary["gaps"], 0) << recovered.out;
  EXPECT_EQ(summary["frames"], 0);
}

TEST_F(RecorderKill, RecoveryOfACompleteFileSaysSoAndOfAnotherFileIsAnError) {
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--rate", "0.5"});
  const auto recorder = start_recorder("run.mcap", {"--frames", "10"});
  await_recorder(*recorder);
  const std::string before = read_file(path("run.mcap"));
  const Ended complete = run("flexcast-record", {"--recover", path("run.mcap").string()});
  EXPECT_EQ(complete.code, 0);
  EXPECT_NE(complete.out.find("is complete"), std::string::npos) << complete.out;
  EXPECT_EQ(read_file(path("run.mcap")), before);
  const Ended other = run("flexcast-record", {"--recover", path("pair.toml").string()});
  EXPECT_EQ(other.code, 1);
  EXPECT_NE(other.err.find("pair.toml"), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("not an MCAP file"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace flexcast::test
