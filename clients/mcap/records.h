// The records of an MCAP file as the reader gives them: fields in the order of the file, text and bytes as views.
#pragma once

#include <cstdint>
#include <string_view>
#include <variant>

#include "clients/mcap/types.h"
#include "clients/mcap/views.h"

namespace flexcast::mcap {

struct Header {
  std::string_view profile;
  std::string_view library;
};

struct Schema {
  SchemaId id = 0;
  std::string_view name;
  std::string_view encoding;
  Bytes data;
};

struct Channel {
  ChannelId id = 0;
  SchemaId schema = 0;
  std::string_view topic;
  std::string_view message_encoding;
  TextMap metadata;
};

struct Message {
  ChannelId channel = 0;
  std::uint32_t sequence = 0;
  Time log_time = 0;
  Time publish_time = 0;
  Bytes data;
};

struct Chunk {
  Time start_time = 0;
  Time end_time = 0;
  std::uint64_t unpacked_bytes = 0;
  std::uint32_t unpacked_crc = 0;  // 0: none
  std::string_view compression;
  Bytes packed;
};

struct MessageIndex {
  ChannelId channel = 0;
  MessageEntries messages;
};

struct ChunkIndex {
  Time start_time = 0;
  Time end_time = 0;
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  ChannelValues message_index_offsets;
  std::uint64_t message_index_bytes = 0;
  std::string_view compression;
  std::uint64_t packed_bytes = 0;
  std::uint64_t unpacked_bytes = 0;
};

struct Attachment {
  Time log_time = 0;
  Time create_time = 0;
  std::string_view name;
  std::string_view media_type;
  Bytes data;
  std::uint32_t crc = 0;  // 0: none
  Bytes checked = {};     // what `crc` is of
};

struct AttachmentIndex {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  Time log_time = 0;
  Time create_time = 0;
  std::uint64_t data_bytes = 0;
  std::string_view name;
  std::string_view media_type;
};

struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  Time start_time = 0;
  Time end_time = 0;
  ChannelValues messages_of_channel;
};

struct Metadata {
  std::string_view name;
  TextMap values;
};

struct MetadataIndex {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::string_view name;
};

struct SummaryOffset {
  std::uint8_t group_opcode = 0;
  std::uint64_t group_start = 0;
  std::uint64_t group_bytes = 0;
};

struct DataEnd {
  std::uint32_t data_section_crc = 0;  // 0: none
};

struct Footer {
  std::uint64_t summary_start = 0;         // 0: no summary
  std::uint64_t summary_offset_start = 0;  // 0: no summary offsets
  std::uint32_t summary_crc = 0;           // 0: none
};

// Of an opcode this library does not know; readers pass over it.
struct UnknownRecord {
  std::uint8_t opcode = 0;
  Bytes body;
};

using Record =
    std::variant<Header, Footer, Schema, Channel, Message, Chunk, MessageIndex, ChunkIndex, Attachment, AttachmentIndex,
                 Statistics, Metadata, MetadataIndex, SummaryOffset, DataEnd, UnknownRecord>;

}  // namespace flexcast::mcap
