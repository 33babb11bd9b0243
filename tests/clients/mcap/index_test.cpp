// Other programs jump to what the indexes name; here each one is followed by hand.
#include "clients/mcap/format.h"
#include "clients/mcap/record_parser.h"
#include "tests/clients/mcap/sample_recording.h"

namespace flexcast::mcap::test {
namespace {

// The record of type T that starts at `offset`; `bytes` is its whole length.
template <class T>
T record_at(Bytes file, std::uint64_t offset, std::uint64_t* bytes = nullptr) {
  const Bytes rest = file.subspan(offset);
  const auto body_bytes = load<std::uint64_t>(rest.subspan(1));
  if (bytes != nullptr) *bytes = kRecordPrefixBytes + body_bytes;
  const auto record =
      parse_record(std::to_integer<std::uint8_t>(rest[0]), rest.subspan(kRecordPrefixBytes, body_bytes));
  EXPECT_TRUE(record && std::holds_alternative<T>(*record)) << "at byte " << offset;
  return record && std::holds_alternative<T>(*record) ? std::get<T>(*record) : T();
}

template <class T, class Visit>
void for_each_in_summary(Bytes file, Visit visit) {
  Reader reader(file);
  while (const Record* record = reader.next()) {
    if (const auto* wanted = std::get_if<T>(record); wanted && reader.in_summary()) visit(*wanted);
  }
}

TEST(McapIndex, ChunkIndexesNameChunksAndTheirMessages) {
  const MemorySink sink = sample_recording({.compression = Compression::kNone, .chunk_bytes = 4096});
  std::size_t messages = 0;
  for_each_in_summary<ChunkIndex>(sink.bytes(), [&](const ChunkIndex& index) {
    std::uint64_t bytes = 0;
    const auto chunk = record_at<Chunk>(sink.bytes(), index.offset, &bytes);
    EXPECT_EQ(bytes, index.bytes);
    EXPECT_EQ(chunk.packed.size(), index.packed_bytes);
    EXPECT_EQ(chunk.unpacked_bytes, index.unpacked_bytes);
    EXPECT_EQ(chunk.start_time, index.start_time);
    EXPECT_EQ(chunk.end_time, index.end_time);
    std::uint64_t index_bytes = 0;
    for (std::size_t i = 0; i < index.message_index_offsets.size(); ++i) {
      const auto [channel, offset] = index.message_index_offsets[i];
      const auto message_index = record_at<MessageIndex>(sink.bytes(), offset, &bytes);
      EXPECT_EQ(message_index.channel, channel);
      index_bytes += bytes;
      for (std::size_t k = 0; k < message_index.messages.size(); ++k) {
        const auto [log_time, place] = message_index.messages[k];
        const auto message = record_at<Message>(chunk.packed, place);
        EXPECT_EQ(message.log_time, log_time);
        EXPECT_EQ(message.channel, channel);
        EXPECT_GE(log_time, index.start_time);
        EXPECT_LE(log_time, index.end_time);
        ++messages;
      }
    }
    EXPECT_EQ(index_bytes, index.message_index_bytes);
  });
  EXPECT_EQ(messages, 200u);
}

TEST(McapIndex, AttachmentAndMetadataIndexesNameTheirRecords) {
  const MemorySink sink = sample_recording({});
  std::size_t found = 0;
  for_each_in_summary<AttachmentIndex>(sink.bytes(), [&](const AttachmentIndex& index) {
    std::uint64_t bytes = 0;
    const auto attachment = record_at<Attachment>(sink.bytes(), index.offset, &bytes);
    EXPECT_EQ(bytes, index.bytes);
    EXPECT_EQ(attachment.name, index.name);
    EXPECT_EQ(attachment.media_type, index.media_type);
    EXPECT_EQ(attachment.data.size(), index.data_bytes);
    EXPECT_NE(attachment.crc, 0u);
    ++found;
  });
  for_each_in_summary<MetadataIndex>(sink.bytes(), [&](const MetadataIndex& index) {
    std::uint64_t bytes = 0;
    EXPECT_EQ(record_at<Metadata>(sink.bytes(), index.offset, &bytes).name, index.name);
    EXPECT_EQ(bytes, index.bytes);
    ++found;
  });
  EXPECT_EQ(found, 2u);
}

TEST(McapIndex, SummaryOffsetsCoverTheSummaryWithoutAGap) {
  const MemorySink sink = sample_recording({});
  Footer footer;
  for_each_in_summary<Footer>(sink.bytes(), [&](const Footer& record) { footer = record; });
  std::uint64_t expected_start = footer.summary_start;
  std::size_t groups = 0;
  for_each_in_summary<SummaryOffset>(sink.bytes(), [&](const SummaryOffset& offset) {
    EXPECT_EQ(offset.group_start, expected_start);
    EXPECT_EQ(std::to_integer<std::uint8_t>(sink.bytes()[offset.group_start]), offset.group_opcode);
    expected_start = offset.group_start + offset.group_bytes;
    ++groups;
  });
  EXPECT_EQ(groups, 6u);
  EXPECT_EQ(expected_start, footer.summary_offset_start);
}

TEST(McapIndex, TheDefaultsSetEveryChecksum) {
  const MemorySink sink = sample_recording({});
  Reader reader(sink.bytes());
  std::size_t checksums = 0;
  while (const Record* record = reader.next()) {
    if (const auto* chunk = std::get_if<Chunk>(record)) checksums += chunk->unpacked_crc != 0;
    if (const auto* attachment = std::get_if<Attachment>(record)) checksums += attachment->crc != 0;
    if (const auto* data_end = std::get_if<DataEnd>(record)) checksums += data_end->data_section_crc != 0;
    if (const auto* footer = std::get_if<Footer>(record)) checksums += footer->summary_crc != 0;
  }
  EXPECT_EQ(checksums, 4u);
}

TEST(McapIndex, ChecksumsThatAreTurnedOffAreZeroAndTheFileIsStillRead) {
  const MemorySink sink =
      sample_recording({.chunk_crc = false, .attachment_crc = false, .data_crc = false, .summary_crc = false});
  const Contents contents = read(sink.bytes());
  EXPECT_EQ(contents.end.ending, Ending::kComplete) << contents.end.message;
  EXPECT_EQ(contents.messages, sample_messages());
}

}  // namespace
}  // namespace flexcast::mcap::test
