// A recording read by libraries that others wrote (tests/interop): they find what our reader finds.
#include <gtest/gtest.h>

#include "tests/system/recording.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

namespace fs = std::filesystem;
using InteropSystem = SystemTest;

// Runs tests/interop/read_recording.mjs on a file.
Json read_with_node(const fs::path& recording) {
  const fs::path folder = fs::path(FLEXCAST_SOURCE_DIR) / "tests/interop";
  if (!fs::exists(folder / "node_modules")) throw std::runtime_error("run `npm ci` in " + folder.string() + " first");
  Process node("/usr/bin/env", {"node", (folder / "read_recording.mjs").string(), recording.string()});
  if (node.wait(patience) != 0) throw std::runtime_error("node found: " + node.err());
  return Json::parse(node.out());
}

TEST_F(InteropSystem, ForeignReadersFindTheSameMessagesFramesAndCoordinates) {
  const auto scene = write_file("pair.toml", pair_scene());
  const auto server = start_server(scene, {"--paused", "--rate", "0.5"});
  auto connection = connect();
  const auto recorder = start_recorder("run.mcap");
  wait_for_frames(1);
  applied(connection.step(100, patience));
  applied(connection.set({{"rope.stiffness", 20.0}}));
  applied(connection.step(100, patience));
  wait_for_frames(201);
  const Json summary = end_recorder(*recorder);

  const Recording ours = read_recording(path("run.mcap"));
  const Json theirs = read_with_node(path("run.mcap"));
  EXPECT_EQ(theirs["complete"], true);
  EXPECT_EQ(theirs["profile"], "");
  EXPECT_EQ(theirs["library"].get<std::string>().substr(0, 9), "flexcast ");
  std::size_t messages = 0;
  for (const auto& [topic, counted] : theirs["topics"].items()) {
    const auto found = ours.messages.find(topic);
    EXPECT_EQ(counted["messages"], found == ours.messages.end() ? 0 : found->second) << topic;
    messages += counted["messages"].get<std::size_t>();
  }
  EXPECT_EQ(summary["messages"], messages);
  EXPECT_EQ(theirs["topics"]["flexcast/frames"]["schema"], "flexcast::ParticleFrame");
  EXPECT_EQ(theirs["topics"]["flexcast/frames"]["gaps"], 0);
  EXPECT_EQ(theirs["attachments"], Json::array({"pair.toml"}));

  ASSERT_EQ(theirs["frames"].size(), 1U);
  const Json& frames = theirs["frames"].at(std::to_string(ours.frames[0].run_id));
  EXPECT_EQ(frames["count"], 201);
  EXPECT_EQ(frames["first"], "0");
  EXPECT_EQ(frames["last"], "200");
  EXPECT_EQ(frames["missing"], "0");
  EXPECT_EQ(frames["incomplete"], 0);
  const auto first_six = [](const FrameMessage& frame) {
    return std::vector<double>(frame.positions64.begin(), frame.positions64.begin() + 6);
  };
  EXPECT_EQ(theirs["first_positions"].get<std::vector<double>>(), first_six(ours.frames.front()));
  EXPECT_EQ(theirs["last_positions"].get<std::vector<double>>(), first_six(ours.frames.back()));
  EXPECT_NE(theirs["first_positions"], theirs["last_positions"]);
}

}  // namespace
}  // namespace flexcast::test
