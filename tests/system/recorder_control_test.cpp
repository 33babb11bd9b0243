// Recorders that another program starts and stops.
#include <gtest/gtest.h>

#include <thread>

#include "idl/wire/fill.h"
#include "idl/wire/writer.h"
#include "tests/system/recording.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

class RecorderControl : public SystemTest {
 protected:
  void send(flexcast_RecorderCommandKind kind, std::uint64_t request_id) const {
    const auto latest = std::chrono::steady_clock::now() + patience;
    while (commands.matched().current == 0 && std::chrono::steady_clock::now() < latest) {
      std::this_thread::sleep_for(5ms);
    }
    wire::Owned<flexcast_RecorderCommand> command;
    wire::set_string(command->world, "pair");
    wire::set_string(command->recorder_id, "left");
    command->request_id = request_id;
    command->kind = kind;
    ASSERT_TRUE(commands.write(*command).ok());
  }

  wire::Participant participant = wire::Participant::create({.domain = domain()}).value();
  wire::Writer<flexcast_RecorderCommand> commands = wire::Writer<flexcast_RecorderCommand>::create(participant).value();
};

TEST_F(RecorderControl, StartsAPausedRecorderAndEndsItAsASignalDoes) {
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--rate", "0.3"});
  const auto recorder = start_waiting_recorder("run.mcap", {"--id", "left", "--paused"});
  ASSERT_TRUE(recorder->wait_for_line("paused:", patience));
  send(flexcast_RECORDER_START, 1);
  wait_for_recorder([](const auto& info) { return info.request_id == 1 && info.state == flexcast_RECORDER_RECORDING; });
  wait_for_frames(20);
  send(flexcast_RECORDER_STOP, 2);
  const Json summary = await_recorder(*recorder);
  EXPECT_GE(summary["frames"], 20);
  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  EXPECT_EQ(recording.frames.size(), summary["frames"]);
  EXPECT_EQ(recording.metadata.at("flexcast.recording").at("ended"), "stopped");
}

}  // namespace
}  // namespace flexcast::test
