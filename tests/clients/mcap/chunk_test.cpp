// When a chunk is closed, and that a closed chunk is in the sink.
#include "tests/clients/mcap/sample_recording.h"

namespace flexcast::mcap::test {
namespace {

using std::chrono_literals::operator""ms;

constexpr Time kMillisecond = 1'000'000;

class McapChunk : public testing::Test {
 protected:
  void start(WriterOptions options) {
    writer_.emplace(sink_, std::move(options));
    channel_ = value_of(writer_->add_channel("flexcast/frames", "cdr", 0));
  }

  void write(Time log_time, std::size_t bytes = 100) {
    const std::string data(bytes, 'x');
    expect_ok(writer_->write_message(channel_, sequence_++, log_time, log_time, bytes_of(data)));
  }

  // What a reader finds if the writer is killed now.
  std::size_t messages_in_sink() const { return read(sink_.bytes()).messages.size(); }

  MemorySink sink_;
  std::optional<Writer> writer_;
  ChannelId channel_ = 0;
  std::uint32_t sequence_ = 0;
};

TEST_F(McapChunk, IsClosedWhenItsBytesReachTheLimit) {
  start({.chunk_bytes = 10'000});
  for (int i = 0; i < 50; ++i) write(i, 1000);
  EXPECT_EQ(messages_in_sink(), 50u);
  EXPECT_EQ(read(sink_.bytes()).messages_until, (std::vector<std::uint64_t>{10, 20, 30, 40, 50}));
}

TEST_F(McapChunk, IsClosedByAMessageThatComesAfterTheInterval) {
  start({.chunk_interval = 250ms});
  write(1'000 * kMillisecond);
  write(1'249 * kMillisecond);
  EXPECT_EQ(messages_in_sink(), 0u);
  write(1'250 * kMillisecond);
  EXPECT_EQ(messages_in_sink(), 2u);
  write(1'499 * kMillisecond);
  EXPECT_EQ(messages_in_sink(), 2u);
  write(1'700 * kMillisecond);
  EXPECT_EQ(messages_in_sink(), 4u);
}

TEST_F(McapChunk, IsClosedByTheClockWhenNoMessageComes) {
  start({.chunk_interval = 250ms});
  write(1'000 * kMillisecond);
  expect_ok(writer_->flush_if_older(1'249 * kMillisecond));
  EXPECT_EQ(messages_in_sink(), 0u);
  expect_ok(writer_->flush_if_older(1'250 * kMillisecond));
  EXPECT_EQ(messages_in_sink(), 1u);
}

TEST_F(McapChunk, StaysOpenWhenTheClockIsSetBack) {
  start({.chunk_interval = 250ms});
  write(1'000 * kMillisecond);
  write(10 * kMillisecond);
  expect_ok(writer_->flush_if_older(0));
  EXPECT_EQ(messages_in_sink(), 0u);
  expect_ok(writer_->close());
  EXPECT_EQ(messages_in_sink(), 2u);
}

TEST_F(McapChunk, IsClosedByFlushAndNoEmptyOneIsWritten) {
  start({});
  write(1);
  expect_ok(writer_->flush());
  const std::uint64_t bytes = writer_->bytes_written();
  expect_ok(writer_->flush());
  expect_ok(writer_->flush_if_older(1'000'000 * kMillisecond));
  EXPECT_EQ(writer_->bytes_written(), bytes);
  EXPECT_EQ(sink_.bytes().size(), bytes);
  EXPECT_EQ(messages_in_sink(), 1u);
}

TEST_F(McapChunk, StartsAgainWithItsOwnTimesAndIndex) {
  start({.compression = Compression::kNone});
  write(5);
  write(3);
  expect_ok(writer_->flush());
  write(9);
  expect_ok(writer_->close());
  std::vector<std::pair<Time, Time>> times;
  std::vector<std::size_t> indexed;
  Reader reader(sink_.bytes());
  while (const Record* record = reader.next()) {
    if (const auto* chunk = std::get_if<Chunk>(record)) times.emplace_back(chunk->start_time, chunk->end_time);
    if (const auto* index = std::get_if<MessageIndex>(record)) indexed.push_back(index->messages.size());
  }
  EXPECT_EQ(times, (std::vector<std::pair<Time, Time>>{{3, 5}, {9, 9}}));
  EXPECT_EQ(indexed, (std::vector<std::size_t>{2, 1}));
}

TEST_F(McapChunk, AttachmentsAndMetadataAreInTheSinkAtOnceAndOutsideOfIt) {
  start({});
  write(1);
  expect_ok(writer_->add_attachment("mesh.msh", "model/mesh", 1, 1, bytes_of("nodes")));
  expect_ok(writer_->add_metadata("host", {{"cores", "2"}}));
  const Contents contents = read(sink_.bytes());
  EXPECT_EQ(contents.attachments.size(), 1u);
  EXPECT_EQ(contents.metadata.size(), 1u);
  EXPECT_TRUE(contents.messages.empty());
}

TEST_F(McapChunk, AWrongIdIsRefusedAndHarmsNothing) {
  start({});
  write(1);
  EXPECT_FALSE(writer_->write_message(channel_ + 1, 0, 2, 2, {}).ok());
  EXPECT_FALSE(writer_->write_message(0, 0, 2, 2, {}).ok());
  EXPECT_EQ(writer_->add_channel("flexcast/events", "cdr", 3).status().message(), "there is no schema 3");
  write(3);
  expect_ok(writer_->close());
  const Contents contents = read(sink_.bytes());
  EXPECT_EQ(contents.end.ending, Ending::kComplete) << contents.end.message;
  EXPECT_EQ(contents.messages.size(), 2u);
}

TEST_F(McapChunk, NothingCanBeAddedAfterClose) {
  start({});
  expect_ok(writer_->close());
  const std::size_t bytes = sink_.bytes().size();
  EXPECT_EQ(writer_->write_message(channel_, 0, 1, 1, {}).message(), "the recording is closed");
  EXPECT_FALSE(writer_->add_metadata("late", {}).ok());
  EXPECT_FALSE(writer_->close().ok());
  EXPECT_EQ(sink_.bytes().size(), bytes);
}

}  // namespace
}  // namespace flexcast::mcap::test
