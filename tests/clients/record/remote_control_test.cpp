// Recorders that other programs start, pause, stop and ask.
#include <optional>

#include "idl/wire/names.h"
#include "idl/wire/reader.h"
#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;

using test::eventually;
using test::Publisher;
using test::TemporaryFile;

// Commands recorders and hears what they say.
class Remote {
 public:
  void await_match(std::uint32_t recorders = 1) const {
    ASSERT_TRUE(eventually([&] { return commands_.matched().current >= recorders; }));
  }

  void send(flexcast_RecorderCommandKind kind, std::uint64_t request_id, const std::string& id = "",
            const std::string& world = "beam") const {
    wire::Owned<flexcast_RecorderCommand> command;
    wire::set_string(command->world, world);
    wire::set_string(command->recorder_id, id);
    command->request_id = request_id;
    command->kind = kind;
    ASSERT_TRUE(commands_.write(*command).ok());
  }

  // Tends the recorder until it has acknowledged the request; what it said then.
  std::string await(Recorder& recorder, std::uint64_t request_id) {
    std::string state = "nothing";
    eventually([&] {
      recorder.tend();
      hear();
      return request_id_ == request_id;
    });
    return request_id_ == request_id ? state_ : state;
  }

  void hear() {
    const auto samples = infos_.take();
    for (const auto [info, sample] : samples.value()) {
      request_id_ = info.request_id;
      state_ = wire::name_of(info.state);
      id_ = wire::text(info.recorder_id);
    }
  }

  std::uint64_t request_id() const { return request_id_; }
  const std::string& state() const { return state_; }
  const std::string& id() const { return id_; }

 private:
  wire::Participant participant_ = flexcast::test::join_test_domain();
  wire::Writer<flexcast_RecorderCommand> commands_ =
      wire::Writer<flexcast_RecorderCommand>::create(participant_).value();
  wire::Reader<flexcast_RecorderInfo> infos_ =
      wire::Reader<flexcast_RecorderInfo>::create(participant_, wire::topic_of<flexcast_RecorderInfo>().recorder)
          .value();
  std::uint64_t request_id_ = 0;
  std::string state_, id_;
};

TEST(RemoteControl, PausesAndStartsARecorderAndWhatCameMeanwhileIsNoGap) {
  const Publisher server("beam");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.id = "left";
  auto recorder = test::start(options);
  Remote remote;
  remote.await_match();
  server.publish_frames(1000, 0, 9);
  ASSERT_TRUE(eventually([&] { return recorder->progress().frames == 10; }));
  remote.send(flexcast_RECORDER_PAUSE, 7);
  EXPECT_EQ(remote.await(*recorder, 7), "paused");
  EXPECT_EQ(remote.id(), "left");
  server.publish_frames(1000, 10, 19);
  server.publish_event(0);
  std::this_thread::sleep_for(50ms);
  remote.send(flexcast_RECORDER_START, 8, "left");
  EXPECT_EQ(remote.await(*recorder, 8), "recording");
  server.publish_frames(1000, 20, 24);
  const Report report = test::finish(*recorder, 15);
  EXPECT_TRUE(report.reception.gaps.empty());
  EXPECT_EQ(report.reception.pauses, (std::vector<Pause>{{1000, 10, 19}}));

  const auto contents = test::read(file);
  EXPECT_EQ(test::messages_of(contents, "flexcast/frames").size(), 15u);
  EXPECT_EQ(test::messages_of(contents, "flexcast/events").size(), 1u);
  EXPECT_EQ(contents.metadata.at("flexcast.gaps").at("missing"), "0");
  EXPECT_EQ(contents.metadata.at("flexcast.gaps").at("paused"), "10");
  EXPECT_EQ(contents.metadata.at("flexcast.gaps").at("pause.0"), "1000 10 19");
}

TEST(RemoteControl, StartsARecorderThatBeganPaused) {
  const Publisher server("beam");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.paused = true;
  auto recorder = test::start(options);
  Remote remote;
  remote.await_match();
  server.publish_topology();
  server.publish_frames(1000, 0, 4);
  remote.send(flexcast_RECORDER_STATUS, 1);
  EXPECT_EQ(remote.await(*recorder, 1), "paused");
  EXPECT_EQ(recorder->progress().frames, 0u);
  remote.send(flexcast_RECORDER_START, 2);
  EXPECT_EQ(remote.await(*recorder, 2), "recording");
  server.publish_frames(1000, 5, 7);
  const Report report = test::finish(*recorder, 3);
  EXPECT_EQ(frame_count(report), 3u);
  EXPECT_EQ(missing_count(report), 0u);
  EXPECT_EQ(test::messages_of(test::read(file), "flexcast/topology").size(), 1u);
}

TEST(RemoteControl, StopsARecorderAndAcknowledgesWhenTheFileIsComplete) {
  const Publisher server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  Remote remote;
  remote.await_match();
  server.publish_frames(1000, 0, 4);
  ASSERT_TRUE(eventually([&] { return recorder->progress().frames == 5; }));
  remote.send(flexcast_RECORDER_STOP, 3);
  EXPECT_TRUE(eventually([&] {
    recorder->tend();
    return recorder->ended();
  }));
  remote.hear();
  EXPECT_NE(remote.request_id(), 3u);
  test::finish(*recorder, 5);
  remote.hear();
  EXPECT_EQ(remote.request_id(), 3u);
  EXPECT_EQ(remote.state(), "finished");
}

TEST(RemoteControl, PassesOverCommandsForOthers) {
  const Publisher server("beam");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.id = "left";
  auto recorder = test::start(options);
  Remote remote;
  remote.await_match();
  remote.send(flexcast_RECORDER_STOP, 1, "right");
  remote.send(flexcast_RECORDER_STOP, 2, "left", "cloth");
  remote.send(flexcast_RECORDER_STATUS, 3, "left");
  EXPECT_EQ(remote.await(*recorder, 3), "recording");
  EXPECT_FALSE(recorder->ended());
  test::finish(*recorder, 0);
}

}  // namespace
}  // namespace flexcast::record
