#include "clients/mcap/summary_builder.h"

#include <algorithm>
#include <string>

#include "clients/mcap/crc32.h"
#include "clients/mcap/encoder.h"

namespace flexcast::mcap {
namespace {

void encode(Encoder& encoder, const std::map<ChannelId, std::uint64_t>& values) {
  encoder.u32(static_cast<std::uint32_t>(values.size() * 10));
  for (const auto& [channel, value] : values) {
    encoder.u16(channel);
    encoder.u64(value);
  }
}

// The record that begins before `body_start`, or nothing of it if a field was too long.
Result<Bytes> finish(Encoder& encoder, std::vector<std::byte>& buffer, std::size_t body_start, std::string_view name) {
  const std::size_t start = body_start - kRecordPrefixBytes;
  if (!encoder.fits()) {
    buffer.resize(start);
    return Status::failure("a field of \"" + std::string(name.substr(0, 80)) + "\" is longer than 4 GiB");
  }
  encoder.end_record(body_start);
  return Bytes(buffer).subspan(start);
}

}  // namespace

Result<Bytes> SummaryBuilder::add_schema(SchemaId id, std::string_view name, std::string_view encoding, Bytes data) {
  Encoder encoder(schemas_);
  const std::size_t start = encoder.begin_record(Opcode::kSchema);
  encoder.u16(id);
  encoder.text(name);
  encoder.text(encoding);
  encoder.counted(data);
  Result<Bytes> record = finish(encoder, schemas_, start, name);
  if (record) ++totals_.schemas;
  return record;
}

Result<Bytes> SummaryBuilder::add_channel(ChannelId id, SchemaId schema, std::string_view topic,
                                          std::string_view message_encoding, const TextPairs& metadata) {
  Encoder encoder(channels_);
  const std::size_t start = encoder.begin_record(Opcode::kChannel);
  encoder.u16(id);
  encoder.u16(schema);
  encoder.text(topic);
  encoder.text(message_encoding);
  encoder.pairs(metadata);
  Result<Bytes> record = finish(encoder, channels_, start, topic);
  if (record) ++totals_.channels;
  return record;
}

void SummaryBuilder::count_message(ChannelId channel, Time log_time) {
  if (totals_.messages == 0) totals_.start_time = totals_.end_time = log_time;
  totals_.start_time = std::min(totals_.start_time, log_time);
  totals_.end_time = std::max(totals_.end_time, log_time);
  ++totals_.messages;
  ++totals_.messages_of_channel[channel];
}

void SummaryBuilder::add_chunk(const ChunkPlace& place, const std::map<ChannelId, std::uint64_t>& message_index_offsets,
                               std::string_view compression) {
  Encoder encoder(chunk_indexes_);
  const std::size_t start = encoder.begin_record(Opcode::kChunkIndex);
  encoder.u64(place.start_time);
  encoder.u64(place.end_time);
  encoder.u64(place.offset);
  encoder.u64(place.bytes);
  encode(encoder, message_index_offsets);
  encoder.u64(place.message_index_bytes);
  encoder.text(compression);
  encoder.u64(place.packed_bytes);
  encoder.u64(place.unpacked_bytes);
  encoder.end_record(start);
  ++totals_.chunks;
}

void SummaryBuilder::add_attachment(const AttachmentPlace& place, std::string_view name, std::string_view media_type) {
  Encoder encoder(attachment_indexes_);
  const std::size_t start = encoder.begin_record(Opcode::kAttachmentIndex);
  encoder.u64(place.offset);
  encoder.u64(place.bytes);
  encoder.u64(place.log_time);
  encoder.u64(place.create_time);
  encoder.u64(place.data_bytes);
  encoder.text(name);
  encoder.text(media_type);
  encoder.end_record(start);
  ++totals_.attachments;
}

void SummaryBuilder::add_metadata(std::uint64_t offset, std::uint64_t bytes, std::string_view name) {
  Encoder encoder(metadata_indexes_);
  const std::size_t start = encoder.begin_record(Opcode::kMetadataIndex);
  encoder.u64(offset);
  encoder.u64(bytes);
  encoder.text(name);
  encoder.end_record(start);
  ++totals_.metadata;
}

std::uint64_t SummaryBuilder::bytes() const {
  constexpr std::uint64_t kRest = 1024;  // statistics, offsets and footer
  std::uint64_t bytes = kRest + 10 * totals_.messages_of_channel.size();
  for (const auto* group : groups()) bytes += group->size();
  return bytes;
}

SummaryBuilder::Mark SummaryBuilder::mark() const {
  Mark mark{.totals = totals_};
  const auto all = groups();
  std::transform(all.begin(), all.end(), mark.sizes.begin(), [](const auto* group) { return group->size(); });
  return mark;
}

void SummaryBuilder::go_back(const Mark& mark) {
  schemas_.resize(mark.sizes[0]);
  channels_.resize(mark.sizes[1]);
  chunk_indexes_.resize(mark.sizes[2]);
  attachment_indexes_.resize(mark.sizes[3]);
  metadata_indexes_.resize(mark.sizes[4]);
  totals_ = mark.totals;
}

Status SummaryBuilder::write(Output& output, bool with_crc) const {
  const std::vector<std::byte> statistics_record = statistics();
  const std::pair<Opcode, Bytes> groups[] = {
      {Opcode::kSchema, schemas_},
      {Opcode::kChannel, channels_},
      {Opcode::kStatistics, statistics_record},
      {Opcode::kChunkIndex, chunk_indexes_},
      {Opcode::kAttachmentIndex, attachment_indexes_},
      {Opcode::kMetadataIndex, metadata_indexes_},
  };
  std::vector<std::byte> tail;
  Encoder encoder(tail);
  const std::uint64_t summary_start = output.offset();
  output.restart_crc();
  for (const auto& [opcode, records] : groups) {
    if (records.empty()) continue;
    const std::size_t start = encoder.begin_record(Opcode::kSummaryOffset);
    encoder.u8(static_cast<std::uint8_t>(opcode));
    encoder.u64(output.offset());
    encoder.u64(records.size());
    encoder.end_record(start);
    if (Status status = output.write(records); !status) return status;
  }
  const std::uint64_t offsets_start = output.offset();
  encoder.record_prefix(Opcode::kFooter, 8 + 8 + 4);
  encoder.u64(summary_start);
  encoder.u64(offsets_start);
  // The checksum covers the footer up to the checksum itself.
  const std::uint32_t crc = crc32(tail, output.crc());
  encoder.u32(with_crc ? crc : 0);
  return output.write(tail);
}

std::vector<std::byte> SummaryBuilder::statistics() const {
  std::vector<std::byte> record;
  Encoder encoder(record);
  const std::size_t start = encoder.begin_record(Opcode::kStatistics);
  encoder.u64(totals_.messages);
  encoder.u16(totals_.schemas);
  encoder.u32(totals_.channels);
  encoder.u32(totals_.attachments);
  encoder.u32(totals_.metadata);
  encoder.u32(totals_.chunks);
  encoder.u64(totals_.start_time);
  encoder.u64(totals_.end_time);
  encode(encoder, totals_.messages_of_channel);
  encoder.end_record(start);
  return record;
}

}  // namespace flexcast::mcap
