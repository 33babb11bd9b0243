// Recordings in several files, and those of the last seconds.
#include <map>
#include <set>

#include "clients/record/recovery.h"
#include "clients/record/ring_parts.h"
#include "clients/record/split_destination.h"
#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;

using test::eventually;
using test::Publisher;
using test::TemporaryFile;

mcap::test::Contents read_complete(const std::string& path) {
  const auto mapped = mcap::MappedFile::open(path);
  if (!mapped) {
    ADD_FAILURE() << mapped.status().message();
    return {};
  }
  auto contents = mcap::test::read(mapped.value().bytes());
  EXPECT_EQ(contents.end.ending, mcap::Ending::kComplete) << contents.end.message;
  return contents;
}

TEST(Parts, AreNamedAfterTheFileWithFourDigits) {
  EXPECT_EQ(part_path("there/run.mcap", 3), "there/run-0003.mcap");
  EXPECT_EQ(part_path("run", 12), "run-0012");
}

TEST(Parts, AreCompleteRecordingsThatTogetherHoldEveryFrameOnceAndNoFrameIsDivided) {
  const Publisher server("beam");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.compression = mcap::Compression::kNone;
  options.split_size = 1'500'000;
  auto recorder = test::start(options);
  server.publish_topology();
  server.publish_parameters(1);
  server.publish_event(0);
  for (std::uint64_t frame = 0; frame < 60; ++frame) {
    if (frame == 40) continue;
    for (std::uint32_t chunk = 0; chunk < 2; ++chunk) server.publish_large_chunk(1000, frame, chunk, 2);
    if (frame == 30) server.publish_event(1);
    std::this_thread::sleep_for(2ms);
  }
  const Report report = test::finish(*recorder, 59);
  ASSERT_GE(report.parts.size(), 5u);
  EXPECT_EQ(frame_count(report), 59u);

  std::map<std::uint32_t, int> chunks;
  std::uint64_t frames = 0, missing = 0, bytes = 0;
  for (const std::string& path : report.parts) {
    const auto contents = read_complete(path);
    EXPECT_LE(std::filesystem::file_size(path), *options.split_size) << path;
    bytes += std::filesystem::file_size(path);
    std::set<std::uint32_t> here;
    for (const std::uint32_t sequence : test::sequences_of(contents, "flexcast/frames")) {
      ++chunks[sequence];
      here.insert(sequence);
    }
    const std::string first = std::to_string(*here.begin()), last = std::to_string(*here.rbegin());
    EXPECT_TRUE(contents.metadata.at("flexcast.recording").at("run.0").starts_with("1000 " + first + " " + last + " "));
    frames += std::stoull(contents.metadata.at("flexcast.recording").at("frames"));
    missing += std::stoull(contents.metadata.at("flexcast.gaps").at("missing"));
    for (const char* topic : {"flexcast/scene", "flexcast/topology", "flexcast/parameters"}) {
      EXPECT_EQ(test::messages_of(contents, topic).size(), 1u) << path << ' ' << topic;
    }
    const std::size_t events = test::messages_of(contents, "flexcast/events").size();
    EXPECT_EQ(events, *here.begin() > 32 ? 2u : *here.rbegin() < 29 ? 1u : events) << path;
    EXPECT_TRUE(contents.attachments.contains("drop.toml")) << path;
    EXPECT_EQ(here.size() * 2, test::messages_of(contents, "flexcast/frames").size()) << "a frame is divided";
    std::filesystem::remove(path);
  }
  EXPECT_EQ(chunks.size(), 59u);
  for (const auto& [frame, count] : chunks) EXPECT_EQ(count, 2) << frame;
  EXPECT_EQ(frames, 59u);
  EXPECT_EQ(missing, 1u);
  EXPECT_EQ(bytes, report.bytes);
}

class LastSeconds : public testing::Test {
 protected:
  LastSeconds() {
    options.keep_last = 0.6;
    recorder = test::start(options);
    server.publish_event(0);
    for (std::uint64_t frame = 0; frame < 150; ++frame) {
      server.publish_frames(1000, frame, frame, 2);
      if (frame % 10 == 0) server.publish_status();
      std::this_thread::sleep_for(10ms);
    }
    EXPECT_TRUE(eventually([&] { return recorder->progress().frames == 150; }));
  }
  ~LastSeconds() override { remove_ring(file.path()); }

  // Exactly the frames of the last 0.6 s before the newest message, each with both chunks.
  void expect_newest(const mcap::test::Contents& contents) const {
    mcap::Time newest = 0, oldest = ~mcap::Time{0};
    std::set<std::uint32_t> frames;
    for (const auto& message : contents.messages) newest = std::max(newest, message.log_time);
    for (const auto& message : test::messages_of(contents, "flexcast/frames")) {
      oldest = std::min(oldest, message.log_time);
      frames.insert(message.sequence);
    }
    ASSERT_FALSE(frames.empty());
    EXPECT_LT(frames.size(), 100u);
    EXPECT_EQ(*frames.rbegin(), 149u);
    EXPECT_EQ(frames.size(), 150u - *frames.begin());
    EXPECT_EQ(test::messages_of(contents, "flexcast/frames").size(), 2 * frames.size());
    EXPECT_GE(oldest + 600'000'000, newest);
    EXPECT_EQ(test::messages_of(contents, "flexcast/events").size(), 1u);
    EXPECT_EQ(test::messages_of(contents, "flexcast/scene").size(), 1u);
    EXPECT_TRUE(contents.attachments.contains("drop.toml"));
    EXPECT_EQ(contents.metadata.at("flexcast.gaps").at("missing"), "0");
    EXPECT_EQ(contents.metadata.at("flexcast.recording").at("frames"), std::to_string(frames.size()));
  }

  const Publisher server{"beam"};
  const TemporaryFile file;
  Options options = test::options_for(file);
  std::unique_ptr<Recorder> recorder;
};

TEST_F(LastSeconds, AreWhatSurvivesOfTheFrames) {
  EXPECT_FALSE(file.exists());
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(ring_folder(file.path()))) ++files;
  EXPECT_LE(files, 6u) << "old parts are removed while it records";
  const Report report = test::finish(*recorder, 150);
  expect_newest(test::read(file));
  EXPECT_EQ(std::to_string(frame_count(report)), test::read(file).metadata.at("flexcast.recording").at("frames"));
  EXPECT_FALSE(std::filesystem::exists(ring_folder(file.path())));
}

TEST_F(LastSeconds, AreBuiltFromThePartsOfAKilledRecorder) {
  // What the disk has now is what a killed recorder leaves.
  std::this_thread::sleep_for(600ms);
  const std::string killed = file.path() + ".killed.mcap";
  std::filesystem::copy(ring_folder(file.path()), ring_folder(killed));
  const auto recovered = recover(killed);
  ASSERT_TRUE(recovered.ok()) << recovered.error().message;
  expect_newest(read_complete(killed));
  EXPECT_FALSE(std::filesystem::exists(ring_folder(killed)));
  EXPECT_EQ(recovered.value().report.reception.end, EndReason::recovered);
  std::filesystem::remove(killed);
  test::finish(*recorder, 150);
}

}  // namespace
}  // namespace flexcast::record
