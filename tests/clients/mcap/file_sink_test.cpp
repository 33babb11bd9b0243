#include "clients/mcap/file_sink.h"

#include <unistd.h>

#include <fstream>

#include "clients/mcap/mapped_file.h"
#include "tests/clients/mcap/sample_recording.h"

namespace flexcast::mcap::test {
namespace {

class McapFileSink : public testing::Test {
 protected:
  McapFileSink() {
    std::string pattern = (std::filesystem::temp_directory_path() / "flexcast_mcap_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    path_ = folder_ / "run.mcap";
  }
  ~McapFileSink() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  std::filesystem::path path_;
};

TEST_F(McapFileSink, AFileHoldsTheSameBytesAsMemory) {
  const MemorySink memory = sample_recording({});
  for (const std::size_t buffer_bytes : {0u, 1u, 1000u, 1'000'000u}) {
    const FileSinkOptions options = {.buffer_bytes = buffer_bytes, .replace_existing = true};
    auto file = value_of(FileSink::create(path_, options));
    Bytes rest = memory.bytes();
    for (std::size_t piece = 1; !rest.empty(); piece = piece * 2 + 1) {
      const std::size_t bytes = std::min(piece, rest.size());
      expect_ok(file->write(rest.first(bytes)));
      rest = rest.subspan(bytes);
    }
    expect_ok(file->close());
    const auto mapped = MappedFile::open(path_);
    ASSERT_TRUE(mapped.ok()) << mapped.status().message();
    EXPECT_EQ(text_of(mapped.value().bytes()), text_of(memory.bytes())) << buffer_bytes;
  }
}

TEST_F(McapFileSink, AClosedChunkIsInTheFileBeforeTheRecordingEnds) {
  auto file = value_of(FileSink::create(path_));
  Writer writer(*file);
  const ChannelId channel = value_of(writer.add_channel("flexcast/frames", "cdr", 0));
  expect_ok(writer.write_message(channel, 0, 1, 1, bytes_of("first")));
  expect_ok(writer.flush());
  expect_ok(writer.write_message(channel, 1, 2, 2, bytes_of("second")));
  const auto mapped = MappedFile::open(path_);
  ASSERT_TRUE(mapped.ok()) << mapped.status().message();
  const Contents contents = read(mapped.value().bytes());
  EXPECT_EQ(contents.end.ending, Ending::kTruncated);
  ASSERT_EQ(contents.messages.size(), 1u);
  EXPECT_EQ(contents.messages[0].data, "first");
}

TEST_F(McapFileSink, AnExistingFileIsKeptUnlessReplacingIsAskedFor) {
  std::ofstream(path_) << "precious";
  const auto refused = FileSink::create(path_);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.status().message(), "cannot create " + path_.string() + ": File exists");
  EXPECT_EQ(std::filesystem::file_size(path_), 8u);
  EXPECT_TRUE(FileSink::create(path_, {.replace_existing = true}).ok());
  EXPECT_EQ(std::filesystem::file_size(path_), 0u);
}

TEST_F(McapFileSink, AMissingFolderIsNamed) {
  const std::filesystem::path path = folder_ / "missing" / "run.mcap";
  EXPECT_EQ(FileSink::create(path).status().message(),
            "cannot create " + path.string() + ": No such file or directory");
  EXPECT_EQ(MappedFile::open(path).status().message(), "cannot open " + path.string() + ": No such file or directory");
}

TEST_F(McapFileSink, WritingAfterCloseFails) {
  auto file = value_of(FileSink::create(path_));
  expect_ok(file->close());
  expect_ok(file->close());
  EXPECT_EQ(file->write(bytes_of("late")).message(), "cannot write " + path_.string() + ": it is closed");
}

TEST_F(McapFileSink, AnEmptyFileIsReadAsTruncated) {
  std::ofstream(path_).flush();
  const auto mapped = MappedFile::open(path_);
  ASSERT_TRUE(mapped.ok()) << mapped.status().message();
  EXPECT_EQ(read(mapped.value().bytes()).end.ending, Ending::kTruncated);
}

TEST_F(McapFileSink, AFolderIsNotAFile) {
  EXPECT_EQ(MappedFile::open(folder_).status().message(),
            "cannot read " + folder_.string() + ": it is not a regular file");
}

TEST(McapDiskFull, TheErrorNamesThePathAndStays) {
  auto file = value_of(FileSink::create("/dev/full", {.replace_existing = true}));
  Writer writer(*file, {.chunk_bytes = 1000});
  const ChannelId channel = value_of(writer.add_channel("flexcast/frames", "cdr", 0));
  const std::string data(2000, 'x');
  const Status status = writer.write_message(channel, 0, 1, 1, bytes_of(data));
  EXPECT_EQ(status.message(), "cannot write /dev/full: No space left on device");
  EXPECT_EQ(writer.write_message(channel, 1, 2, 2, bytes_of(data)).message(), status.message());
  EXPECT_EQ(writer.add_metadata("gaps", {}).message(), status.message());
  EXPECT_EQ(writer.close().message(), status.message());
}

TEST(McapDiskFull, IsNoticedWhenTheFileIsClosed) {
  auto file = value_of(FileSink::create("/dev/full", {.replace_existing = true}));
  expect_ok(file->write(bytes_of("small")));
  EXPECT_EQ(file->close().message(), "cannot write /dev/full: No space left on device");
}

}  // namespace
}  // namespace flexcast::mcap::test
