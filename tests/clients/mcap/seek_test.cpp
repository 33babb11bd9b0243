// Reading from the middle of a file on.
#include <gtest/gtest.h>

#include "clients/mcap/reader.h"
#include "tests/clients/mcap/sample_recording.h"

namespace flexcast::mcap::test {
namespace {

// Sequences of the messages from where the reader is to the end.
std::vector<std::uint32_t> rest_of(Reader& reader) {
  std::vector<std::uint32_t> sequences;
  while (const Record* record = reader.next()) {
    if (const auto* message = std::get_if<Message>(record)) sequences.push_back(message->sequence);
  }
  return sequences;
}

TEST(Seek, ReadsFromAChunkOnWithTheChannelsThatItKnows) {
  const MemorySink sink = sample_recording({.chunk_bytes = 4000});
  Reader reader(sink.bytes());
  std::map<std::uint64_t, std::uint32_t> first_of;  // chunk -> sequence of its first message
  while (const Record* record = reader.next()) {
    if (const auto* message = std::get_if<Message>(record)) first_of.emplace(reader.record_offset(), message->sequence);
  }
  ASSERT_GT(first_of.size(), 5U);
  for (auto chunk = first_of.rbegin(); chunk != first_of.rend(); ++chunk) {
    reader.seek(chunk->first);
    const auto sequences = rest_of(reader);
    ASSERT_EQ(sequences.size(), 200 - chunk->second);
    EXPECT_EQ(sequences.front(), chunk->second);
    EXPECT_EQ(reader.end().ending, Ending::kComplete) << reader.end().message;
  }
}

TEST(Seek, FromTheBeginningTheChecksumOfTheWholeDataIsComparedAgain) {
  const MemorySink sink =
      sample_recording({.compression = Compression::kNone, .chunk_bytes = 4000, .chunk_crc = false});
  std::vector<std::byte> damaged(sink.bytes().begin(), sink.bytes().end());
  Reader reader(damaged);
  std::uint64_t middle = 0;
  for (int chunks = 0; chunks < 3;) {
    const Record* record = reader.next();
    ASSERT_NE(record, nullptr);
    if (!std::holds_alternative<Chunk>(*record)) continue;
    middle = reader.record_offset();
    ++chunks;
  }
  damaged[damaged.size() / 2] ^= std::byte{1};  // within the data of a message
  reader.seek(middle);
  rest_of(reader);
  EXPECT_EQ(reader.end().ending, Ending::kComplete) << reader.end().message;
  reader.seek(0);
  EXPECT_LE(rest_of(reader).size(), 200U);
  EXPECT_EQ(reader.end().ending, Ending::kDamaged);
}

}  // namespace
}  // namespace flexcast::mcap::test
