// flexcast-verify on what a real recorder recorded of a real server.
#include <gtest/gtest.h>

#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

class VerifySystem : public SystemTest {
 protected:
  Ended verify(const std::string& file, Arguments arguments = {}) const {
    arguments.insert(arguments.begin(), path(file).string());
    return run("flexcast-verify", arguments);
  }
};

TEST_F(VerifySystem, ARecordingOfEveryKindOfCommandIsEqualToTheLastBit) {
  write_file("rope.toml", rope_scene());
  const auto server = start_server(write_file("pair.toml", pair_scene()),
                                   {"--paused", "--world", "pair", "--checkpoints", path("checkpoints").string()});
  const auto recorder = start_recorder("run.mcap");
  const std::vector<Arguments> commands = {{"step", "100"},
                                           {"set", "gravity=[0, 0, -3]", "beam.young=5e4", "server.rate=2"},
                                           {"grab", "34", "1", "0.2", "1.5"},
                                           {"step", "100"},
                                           {"save", "here"},
                                           {"set", "time.integrator=backward_euler"},
                                           {"step", "50"},
                                           {"restore", "here"},
                                           {"release", "34"},
                                           {"step", "50"},
                                           {"set", "time.tolerance=1e-3"},
                                           {"step", "50"},
                                           {"reset", "--keep-parameters"},
                                           {"step", "50"},
                                           {"load", "rope"},
                                           {"set", "time.budget=0.5"},
                                           {"step", "100"}};
  for (const Arguments& command : commands) {
    const Ended ended = ctl(command);
    ASSERT_EQ(ended.code, 0) << command[0] << ": " << ended.err;
  }
  wait_for_frames(352 + 51 + 101);
  end_recorder(*recorder);
  for (const std::string threads : {"1", "2"}) {
    const Ended ended = verify("run.mcap", {"--json", "--threads", threads});
    EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
    EXPECT_EQ(ended.err, "") << "silent in a pipe";
    const Json json = Json::parse(ended.out);
    EXPECT_EQ(json["verified"], true);
    ASSERT_EQ(json["runs"].size(), 3U);
    EXPECT_EQ(json["runs"][0]["frames"], 352);
    EXPECT_EQ(json["runs"][1]["frames"], 51);
    EXPECT_EQ(json["runs"][2]["frames"], 101);
  }
}

// The meshes are the recording's: their files are gone when it is executed again.
TEST_F(VerifySystem, AMeshNamedByAnAbsolutePathComesFromTheRecording) {
  const auto mesh = write_file("meshes/corner.node", "4 3 0 0\n0 0 0 0\n1 0.1 0 0\n2 0 0.1 0\n3 0 0 0.1\n");
  write_file("meshes/corner.ele", "1 4 0\n0 0 1 2 3\n");
  const std::string scene =
      "name = \"corner\"\ngravity = [0, 0, -9.81]\n[[body]]\nname = \"stone\"\nmodel = \"fem\"\n"
      "mesh = { file = \"" +
      mesh.string() +
      "\" }\n"
      "material = { law = \"corotational\", young = 1e5, poisson = 0.3, density = 1000.0 }\n";
  {
    const auto server = start_server(write_file("corner.toml", scene), {"--paused"});
    const auto recorder = start_recorder("run.mcap");
    ASSERT_EQ(ctl({"step", "20"}).code, 0);
    wait_for_frames(21);
    end_recorder(*recorder);
  }
  std::filesystem::remove_all(path("meshes"));
  const Ended ended = verify("run.mcap");
  EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_FALSE(std::filesystem::exists(path("meshes")));
}

TEST_F(VerifySystem, WhatCannotBeVerifiedIsAFailureAndBadUsageIsTold) {
  const auto server = start_server(write_file("rope.toml", rope_scene()), {"--paused"});
  const auto recorder = start_recorder("run.mcap");
  ASSERT_EQ(ctl({"step", "20"}).code, 0);
  wait_for_frames(21);
  end_recorder(*recorder);
  EXPECT_EQ(verify("run.mcap").code, 0);
  EXPECT_EQ(verify("run.mcap", {"--run", "2"}).code, 1);
  EXPECT_EQ(verify("none.mcap").code, 1);
  EXPECT_EQ(run("flexcast-verify", {}).code, 2);
  const Ended help = run("flexcast-verify", {"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("Example:"), std::string::npos);
}

}  // namespace
}  // namespace flexcast::test
