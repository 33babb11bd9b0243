#include "clients/mcap/record_parser.h"

#include "clients/mcap/decoder.h"
#include "clients/mcap/format.h"

namespace flexcast::mcap {
namespace {

// Members are initialised in the order they are written, so each brace list reads the fields in the order of the file.

Header parse_header(Decoder& in) {
  return {.profile = in.text(), .library = in.text()};
}

Footer parse_footer(Decoder& in) {
  return {.summary_start = in.u64(), .summary_offset_start = in.u64(), .summary_crc = in.u32()};
}

Schema parse_schema(Decoder& in) {
  return {.id = in.u16(), .name = in.text(), .encoding = in.text(), .data = in.counted()};
}

Channel parse_channel(Decoder& in) {
  return {
      .id = in.u16(), .schema = in.u16(), .topic = in.text(), .message_encoding = in.text(), .metadata = in.text_map()};
}

Message parse_message(Decoder& in) {
  return {.channel = in.u16(), .sequence = in.u32(), .log_time = in.u64(), .publish_time = in.u64(), .data = in.rest()};
}

Chunk parse_chunk(Decoder& in) {
  return {.start_time = in.u64(),
          .end_time = in.u64(),
          .unpacked_bytes = in.u64(),
          .unpacked_crc = in.u32(),
          .compression = in.text(),
          .packed = in.take(in.u64())};
}

MessageIndex parse_message_index(Decoder& in) {
  return {.channel = in.u16(), .messages = in.pair_list<MessageEntries>()};
}

ChunkIndex parse_chunk_index(Decoder& in) {
  return {.start_time = in.u64(),
          .end_time = in.u64(),
          .offset = in.u64(),
          .bytes = in.u64(),
          .message_index_offsets = in.pair_list<ChannelValues>(),
          .message_index_bytes = in.u64(),
          .compression = in.text(),
          .packed_bytes = in.u64(),
          .unpacked_bytes = in.u64()};
}

Attachment parse_attachment(Decoder& in, Bytes body) {
  Attachment attachment = {.log_time = in.u64(),
                           .create_time = in.u64(),
                           .name = in.text(),
                           .media_type = in.text(),
                           .data = in.take(in.u64())};
  attachment.checked = body.first(body.size() - in.rest().size());
  attachment.crc = in.u32();
  return attachment;
}

AttachmentIndex parse_attachment_index(Decoder& in) {
  return {.offset = in.u64(),
          .bytes = in.u64(),
          .log_time = in.u64(),
          .create_time = in.u64(),
          .data_bytes = in.u64(),
          .name = in.text(),
          .media_type = in.text()};
}

Statistics parse_statistics(Decoder& in) {
  return {.messages = in.u64(),
          .schemas = in.u16(),
          .channels = in.u32(),
          .attachments = in.u32(),
          .metadata = in.u32(),
          .chunks = in.u32(),
          .start_time = in.u64(),
          .end_time = in.u64(),
          .messages_of_channel = in.pair_list<ChannelValues>()};
}

Metadata parse_metadata(Decoder& in) {
  return {.name = in.text(), .values = in.text_map()};
}

MetadataIndex parse_metadata_index(Decoder& in) {
  return {.offset = in.u64(), .bytes = in.u64(), .name = in.text()};
}

SummaryOffset parse_summary_offset(Decoder& in) {
  return {.group_opcode = in.u8(), .group_start = in.u64(), .group_bytes = in.u64()};
}

Record parse_fields(std::uint8_t opcode, Decoder& in, Bytes body) {
  switch (static_cast<Opcode>(opcode)) {
    case Opcode::kHeader:
      return parse_header(in);
    case Opcode::kFooter:
      return parse_footer(in);
    case Opcode::kSchema:
      return parse_schema(in);
    case Opcode::kChannel:
      return parse_channel(in);
    case Opcode::kMessage:
      return parse_message(in);
    case Opcode::kChunk:
      return parse_chunk(in);
    case Opcode::kMessageIndex:
      return parse_message_index(in);
    case Opcode::kChunkIndex:
      return parse_chunk_index(in);
    case Opcode::kAttachment:
      return parse_attachment(in, body);
    case Opcode::kAttachmentIndex:
      return parse_attachment_index(in);
    case Opcode::kStatistics:
      return parse_statistics(in);
    case Opcode::kMetadata:
      return parse_metadata(in);
    case Opcode::kMetadataIndex:
      return parse_metadata_index(in);
    case Opcode::kSummaryOffset:
      return parse_summary_offset(in);
    case Opcode::kDataEnd:
      return DataEnd{.data_section_crc = in.u32()};
  }
  return UnknownRecord{.opcode = opcode, .body = body};
}

}  // namespace

std::optional<Record> parse_record(std::uint8_t opcode, Bytes body) {
  Decoder decoder(body);
  Record record = parse_fields(opcode, decoder, body);
  if (!decoder.ok()) return std::nullopt;
  return record;
}

std::string record_name(std::uint8_t opcode) {
  static constexpr const char* kNames[] = {"",           "Header",        "Footer",          "Schema",
                                           "Channel",    "Message",       "Chunk",           "MessageIndex",
                                           "ChunkIndex", "Attachment",    "AttachmentIndex", "Statistics",
                                           "Metadata",   "MetadataIndex", "SummaryOffset",   "DataEnd"};
  if (opcode == 0 || opcode >= std::size(kNames)) return "record of type " + std::to_string(opcode);
  return std::string(kNames[opcode]) + " record";
}

}  // namespace flexcast::mcap
