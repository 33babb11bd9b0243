// Files that were cut short, changed by a bad disk or made to do harm.
#include <random>

#include "clients/mcap/crc32.h"
#include "clients/mcap/encoder.h"
#include "tests/clients/mcap/sample_recording.h"

namespace flexcast::mcap::test {
namespace {

constexpr SampleOptions kSmall = {.messages = 24, .message_bytes = 40};

std::vector<std::byte> small_file(Compression compression) {
  const MemorySink sink = sample_recording({.compression = compression, .chunk_bytes = 400}, kSmall);
  return {sink.bytes().begin(), sink.bytes().end()};
}

class McapDamage : public testing::TestWithParam<Compression> {};

INSTANTIATE_TEST_SUITE_P(Compressions, McapDamage,
                         testing::Values(Compression::kNone, Compression::kLz4, Compression::kZstd), compression_label);

TEST_P(McapDamage, AFileCutAnywhereGivesAllItsWholeChunksAndSaysWhereItEnds) {
  const std::vector<std::byte> file = small_file(GetParam());
  const Contents whole = read(file);
  ASSERT_GT(whole.chunk_offsets.size(), 3u);
  const std::vector<MessageCopy> all = sample_messages(kSmall);
  for (std::size_t bytes = 0; bytes < file.size(); ++bytes) {
    const Contents part = read(Bytes(file).first(bytes));
    ASSERT_EQ(part.end.ending, Ending::kTruncated) << bytes << ": " << part.end.message;
    ASSERT_LE(part.end.intact_bytes, bytes);
    ASSERT_NE(part.end.message.find("truncated after byte " + std::to_string(part.end.intact_bytes)),
              std::string::npos);
    std::size_t expected = 0;
    for (std::size_t chunk = 0; chunk < whole.chunk_offsets.size(); ++chunk) {
      const std::uint64_t start = whole.chunk_offsets[chunk];
      const std::uint64_t end = start + kRecordPrefixBytes + load<std::uint64_t>(Bytes(file).subspan(start + 1));
      if (end <= bytes) expected = whole.messages_until[chunk];
    }
    ASSERT_EQ(part.messages.size(), expected) << bytes;
    ASSERT_TRUE(std::equal(part.messages.begin(), part.messages.end(), all.begin()));
  }
}

TEST_P(McapDamage, OneChangedBitAnywhereIsNoticedAndNoChangedMessageIsGiven) {
  std::vector<std::byte> file = small_file(GetParam());
  const std::vector<MessageCopy> all = sample_messages(kSmall);
  for (std::size_t i = 0; i < file.size(); ++i) {
    for (const std::byte bit : {std::byte{0x01}, std::byte{0x10}, std::byte{0x80}}) {
      file[i] ^= bit;
      const Contents contents = read(file);
      ASSERT_NE(contents.end.ending, Ending::kComplete) << "byte " << i;
      ASSERT_FALSE(contents.end.message.empty());
      for (const MessageCopy& message : contents.messages) ASSERT_EQ(message, all.at(message.sequence)) << "byte " << i;
      file[i] ^= bit;
    }
  }
}

TEST_P(McapDamage, ManyChangedBytesNeverMakeTheReaderLeaveTheFile) {
  const std::vector<std::byte> original = small_file(GetParam());
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::byte> file = original;
    for (int change = 0; change < 1 + round % 8; ++change) {
      file[random() % file.size()] = static_cast<std::byte>(random() & 0xFF);
    }
    const Contents contents = read(file, {.check_crcs = round % 2 == 0, .max_chunk_bytes = 1024 * 1024});
    ASSERT_NE(contents.end.ending, Ending::kOpen);
    ASSERT_LE(contents.end.intact_bytes, file.size());
  }
}

TEST(McapChecksums, AChangedMessageIsNamedAsDamageOfItsChunkAndEarlierOnesAreGiven) {
  std::vector<std::byte> file = small_file(Compression::kNone);
  const Contents whole = read(file);
  const std::uint64_t third = whole.chunk_offsets[2];
  const std::uint64_t bytes = kRecordPrefixBytes + load<std::uint64_t>(Bytes(file).subspan(third + 1));
  file[third + bytes - 1] ^= std::byte{1};
  const Contents contents = read(file);
  EXPECT_EQ(contents.end.ending, Ending::kDamaged);
  EXPECT_EQ(contents.end.message, "damaged at byte " + std::to_string(third) + ": the checksum of a chunk is wrong");
  EXPECT_EQ(contents.messages.size(), whole.messages_until[1]);
}

TEST(McapChecksums, AChangedTimeInAChunksHeadIsCaughtByTheDataSection) {
  std::vector<std::byte> file = small_file(Compression::kLz4);
  const Contents whole = read(file);
  file[whole.chunk_offsets[0] + kRecordPrefixBytes] ^= std::byte{1};
  const Contents contents = read(file);
  EXPECT_EQ(contents.end.ending, Ending::kDamaged);
  EXPECT_EQ(contents.end.message,
            "damaged at byte " + std::to_string(whole.data_end_offset) + ": the checksum of the data section is wrong");
  EXPECT_EQ(contents.messages, sample_messages(kSmall));
}

TEST(McapChecksums, AreNotComparedWhenTurnedOff) {
  std::vector<std::byte> file = small_file(Compression::kNone);
  file[read(file).chunk_offsets[0] + kRecordPrefixBytes] ^= std::byte{1};
  EXPECT_EQ(read(file, {.check_crcs = false}).end.ending, Ending::kComplete);
}

// A file that consists of its head and one record.
std::vector<std::byte> file_with(Opcode opcode, const std::vector<std::byte>& body) {
  std::vector<std::byte> file;
  Encoder encoder(file);
  for (const std::byte byte : kMagic) encoder.u8(std::to_integer<std::uint8_t>(byte));
  const std::size_t start = encoder.begin_record(Opcode::kHeader);
  encoder.text("");
  encoder.text("hostile");
  encoder.end_record(start);
  encoder.record_prefix(opcode, body.size());
  encoder.raw(body);
  return file;
}

std::vector<std::byte> chunk_body(std::string_view compression, std::uint64_t unpacked_bytes, Bytes packed) {
  std::vector<std::byte> body;
  Encoder encoder(body);
  encoder.u64(0);
  encoder.u64(0);
  encoder.u64(unpacked_bytes);
  encoder.u32(0);
  encoder.text(compression);
  encoder.u64(packed.size());
  encoder.raw(packed);
  return body;
}

// The damage a reader names after "damaged at byte N: ".
std::string damage_of(const std::vector<std::byte>& file, ReaderOptions options = {}) {
  const Contents contents = read(file, options);
  EXPECT_EQ(contents.end.ending, Ending::kDamaged);
  EXPECT_TRUE(contents.messages.empty());
  return contents.end.message.substr(contents.end.message.find(": ") + 2);
}

TEST(McapHostile, AChunkThatClaimsToUnpackToMoreThanAllowedIsRefused) {
  EXPECT_EQ(damage_of(file_with(Opcode::kChunk, chunk_body("zstd", 1ull << 62, bytes_of("x")))),
            "a chunk cannot be read: its 4611686018427387904 unpacked bytes are more than the allowed 268435456");
}

TEST(McapHostile, AChunkThatUnpacksToMoreThanItClaimsIsRefused) {
  const std::string zeros(100'000, '\0');
  for (const Compression compression : {Compression::kLz4, Compression::kZstd}) {
    Compressor compressor(compression, 1);
    const Bytes packed = value_of(compressor.compress(bytes_of(zeros)));
    for (const std::uint64_t claimed : {0u, 1u, 99'999u, 100'001u}) {
      const auto body = chunk_body(compression_name(compression), claimed, packed);
      EXPECT_EQ(damage_of(file_with(Opcode::kChunk, body)).rfind("a chunk cannot be read: ", 0), 0u) << claimed;
    }
  }
}

TEST(McapHostile, AnUnknownCompressionIsNamed) {
  EXPECT_EQ(damage_of(file_with(Opcode::kChunk, chunk_body("rar", 1, bytes_of("x")))),
            "a chunk cannot be read: its compression \"rar\" is none of \"\", \"lz4\", \"zstd\"");
}

TEST(McapHostile, AChunkInsideOfAChunkIsRefused) {
  const std::vector<std::byte> inner = chunk_body("", 0, {});
  std::vector<std::byte> records;
  Encoder encoder(records);
  encoder.record_prefix(Opcode::kChunk, inner.size());
  encoder.raw(inner);
  EXPECT_EQ(damage_of(file_with(Opcode::kChunk, chunk_body("", records.size(), records))),
            "Chunk record inside of a chunk");
}

TEST(McapHostile, ARecordThatLeavesItsChunkIsRefused) {
  std::vector<std::byte> records;
  Encoder encoder(records);
  encoder.record_prefix(Opcode::kMessage, ~0ull);
  EXPECT_EQ(damage_of(file_with(Opcode::kChunk, chunk_body("", records.size(), records))),
            "a record ends outside of its chunk");
}

TEST(McapHostile, AListThatLeavesItsRecordIsRefused) {
  std::vector<std::byte> body;
  Encoder encoder(body);
  encoder.text("name");
  encoder.u32(~0u);
  EXPECT_EQ(damage_of(file_with(Opcode::kMetadata, body)), "Metadata record with malformed fields");
}

TEST(McapHostile, AMessageOfAnUnknownChannelIsRefused) {
  EXPECT_EQ(damage_of(file_with(Opcode::kMessage, std::vector<std::byte>(22))),
            "a message names channel 0, which is not there");
}

TEST(McapHostile, DefinitionsBeyondTheLimitAreRefused) {
  std::vector<std::byte> body;
  Encoder encoder(body);
  encoder.u16(1);
  encoder.text("flexcast::ParticleFrame");
  encoder.text("omgidl");
  encoder.text(std::string(5000, ' '));
  EXPECT_EQ(damage_of(file_with(Opcode::kSchema, body), {.max_definition_bytes = 4096}),
            "the schemas and channels take more memory than allowed");
}

TEST(McapHostile, AnotherKindOfFileIsNotAnMcapFile) {
  EXPECT_EQ(read(bytes_of("PK\3\4")).end.message, "damaged at byte 0: this is not an MCAP file of version 0");
}

TEST(McapFile, RecordsOfUnknownTypesArePassedOver) {
  std::vector<std::byte> file = small_file(Compression::kNone);
  const Contents whole = read(file, {.check_crcs = false});
  std::vector<std::byte> unknown;
  Encoder encoder(unknown);
  encoder.record_prefix(static_cast<Opcode>(0x90), 5);
  encoder.raw(bytes_of("later"));
  file.insert(file.begin() + static_cast<std::ptrdiff_t>(whole.data_end_offset), unknown.begin(), unknown.end());
  const Contents contents = read(file, {.check_crcs = false});
  EXPECT_EQ(contents.messages, whole.messages);
  EXPECT_EQ(contents.data_end_offset, whole.data_end_offset + unknown.size());
}

}  // namespace
}  // namespace flexcast::mcap::test
