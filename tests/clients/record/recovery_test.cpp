// Recordings without their end are completed.
#include "clients/record/recovery.h"

#include <fstream>

#include "tests/clients/mcap/sample_recording.h"
#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

using mcap::test::expect_ok;
using test::Publisher;
using test::TemporaryFile;

std::vector<std::byte> content_of(const std::string& path) {
  const auto mapped = mcap::MappedFile::open(path);
  const mcap::Bytes bytes = mapped.value().bytes();
  return {bytes.begin(), bytes.end()};
}

void write(const std::string& path, mcap::Bytes bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

class Recoveries : public testing::TestWithParam<mcap::Compression> {};

INSTANTIATE_TEST_SUITE_P(Recovery, Recoveries,
                         testing::Values(mcap::Compression::kNone, mcap::Compression::kLz4, mcap::Compression::kZstd),
                         mcap::test::compression_label);

TEST_P(Recoveries, OfAFileCutAtAnyByteGiveACompleteFileWithEveryMessageOfItsWholeChunks) {
  const mcap::MemorySink whole = mcap::test::sample_recording({.compression = GetParam(), .chunk_bytes = 400},
                                                              {.messages = 24, .message_bytes = 40});
  for (std::size_t bytes = 0; bytes < whole.bytes().size(); ++bytes) {
    const mcap::Bytes part = whole.bytes().first(bytes);
    const auto expected = mcap::test::read(part);
    mcap::MemorySink sink;
    const auto recovered = recover(part, sink);
    ASSERT_TRUE(recovered.ok()) << bytes << ": " << recovered.status().message();
    ASSERT_EQ(recovered.value().cut_bytes, bytes - expected.end.intact_bytes) << bytes;
    const auto found = mcap::test::read(sink.bytes());
    ASSERT_EQ(found.end.ending, mcap::Ending::kComplete) << bytes << ": " << found.end.message;
    ASSERT_EQ(found.messages, expected.messages) << bytes;
    ASSERT_EQ(found.attachments, expected.attachments) << bytes;
    ASSERT_EQ(found.metadata.contains("gaps"), expected.metadata.contains("gaps")) << bytes;
    ASSERT_EQ(found.metadata.at("flexcast.recording").at("ended"), "recovered");
  }
}

// A recording of some frames with a gap, then the last bytes of it cut off.
class KilledRecording : public testing::Test {
 protected:
  KilledRecording() {
    const Publisher server("beam");
    auto recorder = test::start(test::options_for(file));
    server.publish_topology();
    server.publish_frames(1000, 0, 9, 2);
    server.publish_frames(1000, 13, 19, 2);
    server.publish_frames(1001, 0, 4);
    test::finish(*recorder, 22);
    const std::vector<std::byte> bytes = content_of(file.path());
    write(file.path(), mcap::Bytes(bytes).first(mcap::test::read(bytes).data_end_offset));
  }

  TemporaryFile file;
};

TEST_F(KilledRecording, IsCompletedInPlaceWithTheAccountOfItsFrames) {
  const auto recovered = recover(file.path());
  ASSERT_TRUE(recovered.ok()) << recovered.error().message;
  const Report& report = recovered.value().report;
  EXPECT_FALSE(recovered.value().was_complete);
  EXPECT_EQ(frame_count(report), 22u);
  EXPECT_EQ(report.reception.gaps, (std::vector<Gap>{{1000, 10, 12, GapCause::lost}}));
  const auto contents = test::read(file);
  EXPECT_EQ(test::messages_of(contents, "flexcast/frames").size(), 17u * 2 + 5);
  EXPECT_EQ(test::messages_of(contents, "flexcast/topology").size(), 1u);
  EXPECT_TRUE(contents.attachments.contains("drop.toml"));
  const mcap::TextPairs& recording = contents.metadata.at("flexcast.recording");
  EXPECT_EQ(recording.at("world"), "beam");
  EXPECT_EQ(recording.at("ended"), "recovered");
  EXPECT_EQ(recording.at("server_version"), "9.8.7");
  EXPECT_EQ(recording.at("run.0"), "1000 0 19 17 0");
  EXPECT_EQ(recording.at("run.1"), "1001 0 4 5 0");
  EXPECT_EQ(contents.metadata.at("flexcast.gaps").at("gap.0"), "1000 10 12 lost");
  EXPECT_FALSE(std::filesystem::exists(file.path() + ".new"));
}

TEST_F(KilledRecording, IsCompleteTheSecondTimeAndThenLeftAlone) {
  ASSERT_TRUE(recover(file.path()).ok());
  const std::vector<std::byte> bytes = content_of(file.path());
  const auto again = recover(file.path());
  ASSERT_TRUE(again.ok());
  EXPECT_TRUE(again.value().was_complete);
  EXPECT_NE(to_text(again.value()).find("is complete"), std::string::npos);
  EXPECT_EQ(content_of(file.path()), bytes);
}

TEST_F(KilledRecording, ThatHasItsEndButIsDamagedIsLeftAlone) {
  ASSERT_TRUE(recover(file.path()).ok());
  std::vector<std::byte> bytes = content_of(file.path());
  bytes[bytes.size() / 2] ^= std::byte{1};
  write(file.path(), bytes);
  const auto recovered = recover(file.path());
  ASSERT_FALSE(recovered.ok());
  EXPECT_NE(recovered.error().message.find("left alone: damaged at byte"), std::string::npos)
      << recovered.error().message;
  EXPECT_EQ(content_of(file.path()), bytes);
}

TEST(Recovery, OfAnotherKindOfFileIsAnErrorThatNamesIt) {
  const TemporaryFile file;
  std::ofstream(file.path()) << "PK and whatever else there is in it";
  const auto recovered = recover(file.path());
  ASSERT_FALSE(recovered.ok());
  EXPECT_NE(recovered.error().message.find(file.path() + ": damaged at byte 0: this is not an MCAP file"),
            std::string::npos)
      << recovered.error().message;
  EXPECT_FALSE(std::filesystem::exists(file.path() + ".new"));
  EXPECT_NE(recover(file.path() + ".nowhere").error().message.find(".nowhere"), std::string::npos);
}

}  // namespace
}  // namespace flexcast::record
