// SummaryBuilder: collects, while a file is written, what its summary will say. Each group is kept as finished records.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "clients/mcap/output.h"
#include "clients/mcap/types.h"

namespace flexcast::mcap {

// Totals of a file. Times are 0 without messages.
struct Totals {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  Time start_time = 0;
  Time end_time = 0;
  std::map<ChannelId, std::uint64_t> messages_of_channel;
};

struct ChunkPlace {
  Time start_time = 0;
  Time end_time = 0;
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;                // of the whole chunk record
  std::uint64_t message_index_bytes = 0;  // of all message index records after it
  std::uint64_t packed_bytes = 0;
  std::uint64_t unpacked_bytes = 0;
};

struct AttachmentPlace {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;  // of the whole record
  Time log_time = 0;
  Time create_time = 0;
  std::uint64_t data_bytes = 0;
};

class SummaryBuilder {
 public:
  // The finished record, which the summary repeats and a chunk takes, or why it cannot be encoded. Valid until the
  // next call.
  Result<Bytes> add_schema(SchemaId id, std::string_view name, std::string_view encoding, Bytes data);
  Result<Bytes> add_channel(ChannelId id, SchemaId schema, std::string_view topic, std::string_view message_encoding,
                            const TextPairs& metadata);

  void count_message(ChannelId channel, Time log_time);

  // `message_index_offsets`: where the index record of each channel with messages in this chunk starts.
  void add_chunk(const ChunkPlace& place, const std::map<ChannelId, std::uint64_t>& message_index_offsets,
                 std::string_view compression);
  void add_attachment(const AttachmentPlace& place, std::string_view name, std::string_view media_type);
  void add_metadata(std::uint64_t offset, std::uint64_t bytes, std::string_view name);

  const Totals& totals() const { return totals_; }

  // Of what write() will write, roughly and at least.
  std::uint64_t bytes() const;

  // What the summary says at some moment, to go back to.
  struct Mark {
    std::array<std::size_t, 5> sizes{};  // of the groups
    Totals totals;
  };
  Mark mark() const;
  void go_back(const Mark& mark);

  // Summary, summary offsets and footer (with the checksum over them if `with_crc`).
  Status write(Output& output, bool with_crc) const;

 private:
  std::vector<std::byte> statistics() const;
  std::array<const std::vector<std::byte>*, 5> groups() const {
    return {&schemas_, &channels_, &chunk_indexes_, &attachment_indexes_, &metadata_indexes_};
  }

  std::vector<std::byte> schemas_;
  std::vector<std::byte> channels_;
  std::vector<std::byte> chunk_indexes_;
  std::vector<std::byte> attachment_indexes_;
  std::vector<std::byte> metadata_indexes_;
  Totals totals_;
};

}  // namespace flexcast::mcap
