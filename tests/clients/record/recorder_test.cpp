// How recordings begin and end, and what others see of them.
#include "clients/record/recorder.h"

#include <fstream>

#include "idl/wire/names.h"
#include "idl/wire/reader.h"
#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;
using test::eventually;
using test::Publisher;
using test::TemporaryFile;

std::string start_error(
    const Options& options, const Interrupted& interrupted = [] { return false; }) {
  const auto started = Recorder::start(options, interrupted);
  return started ? "started" : started.error().message;
}

TEST(Recorder, EndsByItselfAfterTheFramesItWasAskedFor) {
  const Publisher server("beam");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.frames = 25;
  auto recorder = test::start(options);
  server.publish_frames(1000, 0, 99, 2);
  EXPECT_TRUE(eventually([&] { return recorder->ended(); }));
  const Report report = test::finish(*recorder, 25);
  EXPECT_EQ(frame_count(report), 25u);
  EXPECT_EQ(missing_count(report), 0u);
  EXPECT_EQ(report.reception.end, EndReason::frames);
  EXPECT_EQ(test::messages_of(test::read(file), "flexcast/frames").size(), 50u);
}

TEST(Recorder, EndsByItselfSomeTimeAfterTheFirstFrame) {
  const Publisher server("beam");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.duration = 0.3;
  auto recorder = test::start(options);
  std::this_thread::sleep_for(400ms);
  EXPECT_FALSE(recorder->ended()) << "there was no frame yet";
  server.publish_frames(1000, 0, 0);
  EXPECT_TRUE(eventually([&] { return recorder->ended(); }));
  const Report report = test::finish(*recorder, 1);
  EXPECT_EQ(report.reception.end, EndReason::duration);
  EXPECT_GE(report.reception.seconds, 0.3);
}

TEST(Recorder, WaitsForTheRestOfAFrameThatHasBegun) {
  const Publisher server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 0, 4, 2);
  server.publish_chunk(1000, 5, 0, 2);
  std::thread late([&] {
    std::this_thread::sleep_for(100ms);
    server.publish_chunk(1000, 6, 0, 2);
    server.publish_chunk(1000, 5, 1, 2);
  });
  const Report report = test::finish(*recorder, 5);
  late.join();
  EXPECT_EQ(frame_count(report), 6u);
  EXPECT_EQ(missing_count(report), 0u);
}

TEST(Recorder, TakesTheOnlyWorldOfTheDomain) {
  const Publisher server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file, ""));
  EXPECT_EQ(recorder->world(), "beam");
  EXPECT_TRUE(recorder->finish().ok());
}

TEST(Recorder, ListsTheWorldsWhenThereAreSeveralAndNoneIsNamed) {
  const Publisher server("beam"), other("cloth");
  const TemporaryFile file;
  const std::string error = start_error(test::options_for(file, ""));
  EXPECT_NE(error.find("beam, cloth"), std::string::npos) << error;
  EXPECT_FALSE(file.exists());
}

TEST(Recorder, SaysWhatItLookedForWhenThereIsNoServer) {
  const Publisher other("cloth");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.wait = 0.3;
  const std::string error = start_error(options);
  for (const std::string part : {"'beam'", "loopback", "0.3 s", "cloth"}) {
    EXPECT_NE(error.find(part), std::string::npos) << error;
  }
  EXPECT_NE(error.find("domain " + std::to_string(options.domain)), std::string::npos) << error;
  EXPECT_FALSE(file.exists());
}

TEST(Recorder, CanBeInterruptedWhileItWaits) {
  const TemporaryFile file;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(start_error(test::options_for(file), [] { return true; }).find("interrupted"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
}

TEST(Recorder, ReplacesAFileOnlyWhenForced) {
  const Publisher server("beam");
  const TemporaryFile file;
  std::ofstream(file.path()) << "precious";
  Options options = test::options_for(file);
  EXPECT_NE(start_error(options).find("--force"), std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(file.path()), 8u);
  options.force = true;
  auto recorder = test::start(options);
  server.publish_frames(1000, 0, 1);
  const Report report = test::finish(*recorder, 2);
  EXPECT_EQ(test::messages_of(test::read(file), "flexcast/frames").size(), 2u);
  EXPECT_EQ(std::filesystem::file_size(file.path()), report.bytes);
}

TEST(Recorder, EndsWithTheSystemsReasonWhenTheDiskIsFull) {
  const Publisher server("beam");
  Options options = test::options_for(TemporaryFile());
  options.file = "/dev/full";
  options.force = true;
  auto recorder = test::start(options);
  server.publish_frames(1000, 0, 1);
  EXPECT_TRUE(eventually([&] {
    server.publish_status();
    return recorder->ended();
  }));
  const auto report = recorder->finish();
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.error().message.find("/dev/full: No space left"), std::string::npos) << report.error().message;
}

TEST(Recorder, TellsTheDomainWhatItDoes) {
  const Publisher server("beam");
  const auto participant = flexcast::test::join_test_domain();
  const auto reader =
      wire::Reader<flexcast_RecorderInfo>::create(participant, wire::topic_of<flexcast_RecorderInfo>().recorder)
          .value();
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 0, 2);
  server.publish_frames(1000, 4, 4);
  test::finish(*recorder, 4);

  std::vector<std::string> states;
  const auto samples = reader.take();
  ASSERT_TRUE(samples.ok());
  for (const auto [info, sample] : samples.value()) {
    EXPECT_EQ(wire::text(info.world), "beam");
    EXPECT_EQ(wire::text(info.file), file.path());
    states.emplace_back(wire::name_of(info.state));
    if (info.state != flexcast_RECORDER_FINISHED) continue;
    EXPECT_EQ(info.run_id, 1000u);
    EXPECT_EQ(info.next_frame, 5u);
    EXPECT_EQ(info.frames, 4u);
    EXPECT_EQ(info.gaps, 1u);
    EXPECT_EQ(info.bytes, std::filesystem::file_size(file.path()));
  }
  EXPECT_EQ(states, (std::vector<std::string>{"waiting", "recording", "finished"}));
}

TEST(Recorder, IsHeardOnceASecond) {
  const Publisher server("beam");
  const auto participant = flexcast::test::join_test_domain();
  const auto reader =
      wire::Reader<flexcast_RecorderInfo>::create(participant, wire::topic_of<flexcast_RecorderInfo>().recorder)
          .value();
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  for (int i = 0; i < 25; ++i) {
    EXPECT_EQ(recorder->tend(), "");
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_GE(reader.take().value().size(), 3u);
  EXPECT_TRUE(recorder->finish().ok());
}

}  // namespace
}  // namespace flexcast::record
