// flexcast-replay against the other real programs: a recording of a replay is the recording, and flexcast-ctl steers
// it.
#include <gtest/gtest.h>

#include <cstdlib>

#include "clients/mcap/mapped_file.h"
#include "tests/system/recording.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

namespace fs = std::filesystem;

// The bytes of every message of the topic, in the order of the file.
std::vector<std::string> messages_of(const fs::path& file, const std::string& topic) {
  const auto mapped = mcap::MappedFile::open(file).value();
  mcap::Reader reader(mapped.bytes());
  std::vector<std::string> messages;
  while (const mcap::Record* record = reader.next()) {
    const auto* message = std::get_if<mcap::Message>(record);
    if (message == nullptr || reader.channel(message->channel)->topic != topic) continue;
    messages.emplace_back(reinterpret_cast<const char*>(message->data.data()), message->data.size());
  }
  return messages;
}

class ReplayProgram : public SystemTest {
 protected:
  // A recording of so many steps of the pair scene, a frame each; with `change` a parameter is set half-way.
  void record(std::uint64_t steps, bool change = true) {
    const auto server = start_server(write_file("pair.toml", pair_scene()), {"--paused", "--rate", "1"});
    auto connection = connect();
    const auto recorder = start_recorder("run.mcap");
    wait_for_frames(1);
    applied(connection.step(steps / 2, patience));
    if (change) applied(connection.set({{"rope.stiffness", 20.0}}));
    applied(connection.step(steps - steps / 2, patience));
    wait_for_frames(steps + 1);
    EXPECT_EQ(end_recorder(*recorder)["gaps"], 0);
    end(*server, SIGTERM);
  }

  std::unique_ptr<Process> start_replay(Arguments arguments) const {
    arguments.insert(arguments.begin(), {path("run.mcap").string(), "--domain", std::to_string(domain())});
    auto replay = start("flexcast-replay", arguments);
    if (!replay->wait_for_line("ready:", patience)) throw std::runtime_error("the replay does not start");
    return replay;
  }
};

TEST_F(ReplayProgram, ARecordingOfAReplayHasTheSameFramesAndDefinitionsByteForByte) {
  const std::uint64_t steps = std::getenv("FLEXCAST_LONG") != nullptr ? 20000 : 1500;
  record(steps);
  const auto replay = start_replay({"--paused"});
  const auto recorder = start_recorder("again.mcap");
  wait_for_frames(1);
  auto connection = connect();
  applied(connection.resume());
  wait_for_frames(steps + 1);
  wait_for_status(connection, [](const flexcast_Status& status) { return status.state == flexcast_WORLD_FINISHED; });
  const Json summary = end_recorder(*recorder);
  EXPECT_EQ(summary["gaps"], 0);
  EXPECT_EQ(summary["frames"], steps + 1);
  for (const char* topic : {"flexcast/frames", "flexcast/events"}) {
    const auto recorded = messages_of(path("run.mcap"), topic);
    EXPECT_FALSE(recorded.empty()) << topic;
    EXPECT_TRUE(messages_of(path("again.mcap"), topic) == recorded) << topic;
  }
  // Of these a late reader gets the newest alone, as from a server.
  for (const char* topic : {"flexcast/scene", "flexcast/topology", "flexcast/parameters"}) {
    EXPECT_EQ(messages_of(path("again.mcap"), topic).back(), messages_of(path("run.mcap"), topic).back()) << topic;
  }
  EXPECT_EQ(end(*replay, SIGINT).find("ready: world pair on domain " + std::to_string(domain())), 0U);
}

TEST_F(ReplayProgram, FlexcastCtlSteersIt) {
  record(400, false);
  const auto replay = start_replay({"--paused", "--as", "again"});
  auto connection = connect("again");  // waits as long as it takes; ctl list does not
  EXPECT_EQ(ctl_json({"step", "5"})["applied_step"], 5);
  EXPECT_EQ(ctl_json({"status"})["step"], 5);
  EXPECT_EQ(ctl_json({"status"})["state"], "paused");
  EXPECT_EQ(ctl_json({"set", "replay.time=0.25"})["applied_step"], 250);
  EXPECT_EQ(ctl_json({"run-until", "0.3"})["applied_step"], 300);
  EXPECT_EQ(ctl_json({"set", "replay.rate=0"})["values"]["replay.rate"], 0);
  ctl_json({"resume"});
  wait_for_status(connection, [](const flexcast_Status& status) { return status.state == flexcast_WORLD_FINISHED; });
  EXPECT_EQ(ctl_json({"status"})["step"], 400);
  EXPECT_EQ(ctl({"resume"}).code, 1);
  EXPECT_NE(ctl({"grab", "1", "0", "0", "0"}).err.find("unsupported"), std::string::npos);
  EXPECT_EQ(ctl_json({"reset"})["applied_step"], 0);
  end(*replay, SIGTERM);
  EXPECT_EQ(ctl_json({"list"})["worlds"].size(), 0U);  // it said goodbye
}

TEST_F(ReplayProgram, WithExitItEndsWithTheRecordingAndAKilledRecordersFileIsReplayedAsFarAsItGoes) {
  record(100, false);
  const fs::path file = path("run.mcap");
  fs::resize_file(file, fs::file_size(file) - 100);
  const Ended ended = run("flexcast-replay", {file.string(), "--domain", std::to_string(domain()), "--exit"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.out.find("101 frames in 1 run"), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find("truncated"), std::string::npos) << ended.err;
  EXPECT_EQ(run("flexcast-replay", {path("none.mcap").string()}).code, 1);
  EXPECT_EQ(run("flexcast-replay", {}).code, 2);
}

TEST_F(ReplayProgram, AServerOfThatNameKeepsIt) {
  record(20, false);
  const auto server = start_server(path("pair.toml"), {"--paused"});
  const Ended ended = run("flexcast-replay", {path("run.mcap").string(), "--domain", std::to_string(domain())});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("world 'pair' is on domain"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace flexcast::test
