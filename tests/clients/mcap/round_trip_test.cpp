#include "tests/clients/mcap/sample_recording.h"

namespace flexcast::mcap::test {
namespace {

class McapRoundTrip : public testing::TestWithParam<Compression> {
 protected:
  WriterOptions options() const { return {.compression = GetParam(), .chunk_bytes = 4096}; }
};

INSTANTIATE_TEST_SUITE_P(Compressions, McapRoundTrip,
                         testing::Values(Compression::kNone, Compression::kLz4, Compression::kZstd), compression_label);

TEST_P(McapRoundTrip, WhatIsWrittenIsRead) {
  const MemorySink sink = sample_recording(options());
  const Contents contents = read(sink.bytes());
  EXPECT_EQ(contents.end.ending, Ending::kComplete) << contents.end.message;
  EXPECT_EQ(contents.end.intact_bytes, sink.bytes().size());
  EXPECT_EQ(contents.profile, "");
  EXPECT_EQ(contents.library, "flexcast " FLEXCAST_VERSION);
  EXPECT_EQ(contents.messages, sample_messages());
  EXPECT_GT(contents.compressions.size(), 10u);
  EXPECT_EQ(contents.compressions.front(), compression_name(GetParam()));
  EXPECT_EQ(contents.metadata, (std::map<std::string, TextPairs>{{"gaps", {{"count", "0"}, {"run", "7"}}}}));
  const AttachmentCopy scene = {"application/toml", 5, 4, "[world]\nname = \"beam\"\n"};
  EXPECT_EQ(contents.attachments, (std::map<std::string, AttachmentCopy>{{"beam.toml", scene}}));
}

TEST_P(McapRoundTrip, TheSummaryCountsEverything) {
  const Contents contents = read(sample_recording(options()).bytes());
  ASSERT_TRUE(contents.totals.has_value());
  const Totals& totals = *contents.totals;
  EXPECT_EQ(totals.messages, 200u);
  EXPECT_EQ(totals.schemas, 1u);
  EXPECT_EQ(totals.channels, 2u);
  EXPECT_EQ(totals.attachments, 1u);
  EXPECT_EQ(totals.metadata, 1u);
  EXPECT_EQ(totals.chunks, contents.compressions.size());
  EXPECT_EQ(totals.start_time, 1000u);
  EXPECT_EQ(totals.end_time, 1000u + 10 * 199);
  EXPECT_EQ(totals.messages_of_channel, (std::map<ChannelId, std::uint64_t>{{1, 133}, {2, 67}}));
}

TEST_P(McapRoundTrip, MessagesLargerThanAChunkAreKeptWhole) {
  const SampleOptions large = {.messages = 4, .message_bytes = 9'000'000};
  const Contents contents = read(sample_recording(options(), large).bytes());
  EXPECT_EQ(contents.end.ending, Ending::kComplete) << contents.end.message;
  EXPECT_TRUE(contents.messages == sample_messages(large));
  EXPECT_EQ(contents.compressions.size(), 4u);
}

TEST_P(McapRoundTrip, MessagesWithoutDataAreKept) {
  const SampleOptions empty = {.messages = 14, .message_bytes = 0};
  const Contents contents = read(sample_recording(options(), empty).bytes());
  EXPECT_EQ(contents.end.ending, Ending::kComplete) << contents.end.message;
  EXPECT_EQ(contents.messages, sample_messages(empty));
}

TEST_P(McapRoundTrip, ChannelsAndSchemasAreKnownBeforeTheirMessages) {
  const MemorySink sink = sample_recording(options());
  Reader reader(sink.bytes());
  std::size_t messages = 0;
  while (const Record* record = reader.next()) {
    const auto* message = std::get_if<Message>(record);
    if (message == nullptr) continue;
    ++messages;
    const ChannelInfo* channel = reader.channel(message->channel);
    ASSERT_NE(channel, nullptr);
    EXPECT_TRUE(reader.in_chunk());
    if (channel->schema == 0) continue;
    EXPECT_EQ(channel->metadata, (TextPairs{{"qos", "reliable"}}));
    ASSERT_NE(reader.schema(channel->schema), nullptr);
    EXPECT_EQ(reader.schema(channel->schema)->name, "flexcast::ParticleFrame");
    EXPECT_EQ(reader.schema(channel->schema)->data, "struct ParticleFrame {};");
  }
  EXPECT_EQ(messages, 200u);
}

TEST(McapFile, AnEmptyRecordingIsValid) {
  MemorySink sink;
  Writer writer(sink);
  expect_ok(writer.close());
  const Contents contents = read(sink.bytes());
  EXPECT_EQ(contents.end.ending, Ending::kComplete) << contents.end.message;
  ASSERT_TRUE(contents.totals.has_value());
  EXPECT_EQ(contents.totals->messages, 0u);
  EXPECT_EQ(contents.totals->chunks, 0u);
}

TEST(McapFile, ChannelsWithoutMessagesAreInTheFile) {
  MemorySink sink;
  Writer writer(sink);
  const SchemaId schema = value_of(writer.add_schema("flexcast::Event", "omgidl", "struct Event {};"));
  static_cast<void>(value_of(writer.add_channel("flexcast/events", "cdr", schema)));
  expect_ok(writer.close());
  Reader reader(sink.bytes());
  while (reader.next() != nullptr) {
  }
  EXPECT_EQ(reader.end().ending, Ending::kComplete) << reader.end().message;
  ASSERT_NE(reader.channel(1), nullptr);
  EXPECT_EQ(reader.channel(1)->topic, "flexcast/events");
}

TEST(McapFile, TheSameInputGivesTheSameBytes) {
  const MemorySink first = sample_recording({});
  const MemorySink second = sample_recording({});
  EXPECT_EQ(text_of(first.bytes()), text_of(second.bytes()));
}

}  // namespace
}  // namespace flexcast::mcap::test
