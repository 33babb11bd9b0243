#include "clients/mcap/writer.h"

#include <limits>
#include <map>
#include <utility>

#include "clients/mcap/crc32.h"
#include "clients/mcap/encoder.h"

namespace flexcast::mcap {
namespace {

constexpr std::size_t kLargeMessage = std::size_t{256} * 1024;
constexpr std::uint64_t kRoom = std::uint64_t{256} * 1024;  // beside the summary, after a cut

}  // namespace

Writer::Writer(ByteSink& sink, WriterOptions options)
    : options_(std::move(options)),
      output_(sink),
      chunk_(options_.chunk_bytes),
      compressor_(options_.compression, options_.zstd_level) {
  Encoder encoder(scratch_);
  const std::size_t start = encoder.begin_record(Opcode::kHeader);
  encoder.text(options_.profile);
  encoder.text(options_.library);
  encoder.end_record(start);
  // The output keeps a failure for the next call.
  static_cast<void>(output_.write(kMagic));
  static_cast<void>(output_.write(scratch_));
}

Result<SchemaId> Writer::add_schema(std::string_view name, std::string_view encoding, std::string_view data) {
  return add_schema(name, encoding, std::as_bytes(std::span(data)));
}

Result<SchemaId> Writer::add_schema(std::string_view name, std::string_view encoding, Bytes data) {
  if (Status status = ready(); !status) return status;
  if (totals().schemas == std::numeric_limits<SchemaId>::max()) return Status::failure("a file holds 65535 schemas");
  const auto id = static_cast<SchemaId>(totals().schemas + 1);
  const Result<Bytes> record = summary_.add_schema(id, name, encoding, data);
  if (!record) return record.status();
  if (Status status = add_definition(record.value()); !status) return status;
  return id;
}

Result<ChannelId> Writer::add_channel(std::string_view topic, std::string_view message_encoding, SchemaId schema,
                                      const TextPairs& metadata) {
  if (Status status = ready(); !status) return status;
  if (totals().channels == std::numeric_limits<ChannelId>::max()) return Status::failure("a file holds 65535 channels");
  if (schema > totals().schemas) return Status::failure("there is no schema " + std::to_string(schema));
  const auto id = static_cast<ChannelId>(totals().channels + 1);
  const Result<Bytes> record = summary_.add_channel(id, schema, topic, message_encoding, metadata);
  if (!record) return record.status();
  if (Status status = add_definition(record.value()); !status) return status;
  return id;
}

Status Writer::write_message(ChannelId channel, std::uint32_t sequence, Time log_time, Time publish_time, Bytes data) {
  if (Status status = ready(); !status) return status;
  if (channel == 0 || channel > totals().channels) {
    return Status::failure("there is no channel " + std::to_string(channel));
  }
  if (is_due(log_time)) {
    if (Status status = write_chunk(); !status) return status;
  }
  chunk_.add_message_head(channel, sequence, log_time, publish_time, data.size());
  summary_.count_message(channel, log_time);
  if (options_.compression == Compression::kNone && data.size() >= kLargeMessage) return write_chunk(data);
  chunk_.add_data(data);
  return chunk_.records().size() >= options_.chunk_bytes ? write_chunk() : Status();
}

Status Writer::add_attachment(std::string_view name, std::string_view media_type, Time log_time, Time create_time,
                              Bytes data) {
  if (Status status = ready(); !status) return status;
  scratch_.clear();
  Encoder encoder(scratch_);
  const std::uint64_t field_bytes = 8 + 8 + 4 + name.size() + 4 + media_type.size() + 8;
  const std::uint64_t body_bytes = field_bytes + data.size() + 4;
  encoder.record_prefix(Opcode::kAttachment, body_bytes);
  encoder.u64(log_time);
  encoder.u64(create_time);
  encoder.text(name);
  encoder.text(media_type);
  encoder.u64(data.size());
  if (!encoder.fits()) return Status::failure("the name of an attachment is longer than 4 GiB");

  const AttachmentPlace place = {.offset = output_.offset(),
                                 .bytes = kRecordPrefixBytes + body_bytes,
                                 .log_time = log_time,
                                 .create_time = create_time,
                                 .data_bytes = data.size()};
  const std::uint32_t data_crc = crc32(data);
  const std::uint32_t field_crc = crc32(Bytes(scratch_).subspan(kRecordPrefixBytes));
  if (Status status = output_.write(scratch_); !status) return status;
  if (Status status = output_.write(data, data_crc); !status) return status;
  scratch_.clear();
  encoder.u32(options_.attachment_crc ? crc32_join(field_crc, data_crc, data.size()) : 0);
  if (Status status = output_.write(scratch_); !status) return status;
  summary_.add_attachment(place, name, media_type);
  return output_.flush();
}

Status Writer::add_metadata(std::string_view name, const TextPairs& values) {
  if (Status status = ready(); !status) return status;
  scratch_.clear();
  Encoder encoder(scratch_);
  const std::size_t start = encoder.begin_record(Opcode::kMetadata);
  encoder.text(name);
  encoder.pairs(values);
  encoder.end_record(start);
  if (!encoder.fits()) return Status::failure("a metadata record is longer than 4 GiB");
  const std::uint64_t offset = output_.offset();
  if (Status status = output_.write(scratch_); !status) return status;
  summary_.add_metadata(offset, scratch_.size(), name);
  return output_.flush();
}

Status Writer::flush_if_older(Time now) {
  if (Status status = ready(); !status) return status;
  return is_due(now) ? write_chunk() : Status();
}

Status Writer::flush() {
  if (Status status = ready(); !status) return status;
  return write_chunk();
}

Status Writer::close() {
  if (Status status = flush(); !status) return status;
  closed_ = true;
  const std::uint32_t data_crc = options_.data_crc ? output_.crc() : 0;
  scratch_.clear();
  Encoder encoder(scratch_);
  encoder.record_prefix(Opcode::kDataEnd, 4);
  encoder.u32(data_crc);
  if (Status status = output_.write(scratch_); !status) return status;
  if (Status status = summary_.write(output_, options_.summary_crc); !status) return status;
  if (Status status = output_.write(kMagic); !status) return status;
  return output_.flush();
}

Status Writer::ready() const {
  if (!output_.status()) return output_.status();
  return closed_ ? Status::failure("the recording is closed") : Status();
}

Status Writer::add_definition(Bytes record) {
  chunk_.add_record(record);
  return chunk_.records().size() >= options_.chunk_bytes ? write_chunk() : Status();
}

bool Writer::is_due(Time now) const {
  const auto interval = static_cast<Time>(options_.chunk_interval.count());
  return chunk_.has_messages() && now > chunk_.first_log_time() && now - chunk_.first_log_time() >= interval;
}

Status Writer::write_chunk(Bytes last_data) {
  const Bytes records = chunk_.records();
  if (records.empty()) return output_.flush();
  ChunkPlace place = {.start_time = chunk_.start_time(),
                      .end_time = chunk_.end_time(),
                      .offset = output_.offset(),
                      .unpacked_bytes = records.size() + last_data.size()};
  if (Status status = write_chunk_record(records, last_data, place); !status) return status;
  if (Status status = write_message_indexes(place); !status) return status;
  chunk_.clear();
  if (Status status = output_.flush(); !status) return status;
  note_chunk_end();
  return {};
}

void Writer::note_chunk_end() {
  chunk_ends_.push_back({output_.offset(), output_.crc(), summary_.bytes(), summary_.mark()});
  sound_bytes_ = output_.offset();
  const auto leaves_room = [this](const ChunkEnd& end) {
    return end.offset + end.summary_bytes + kRoom <= sound_bytes_;
  };
  while (chunk_ends_.size() > 1 && leaves_room(chunk_ends_[1])) chunk_ends_.pop_front();
}

Status Writer::cut_back(std::uint64_t room) {
  const Status failure = output_.status() ? Status::failure("there is nothing to cut back") : output_.status();
  while (chunk_ends_.size() > 1 && chunk_ends_.back().offset + chunk_ends_.back().summary_bytes + room > sound_bytes_) {
    chunk_ends_.pop_back();
  }
  if (chunk_ends_.empty()) return failure;
  const ChunkEnd end = chunk_ends_.back();
  chunk_ends_.pop_back();  // the next call goes further back
  if (Status status = output_.cut(end.offset, end.crc); !status) return failure;
  chunk_.clear();
  summary_.go_back(end.summary);
  closed_ = false;
  return {};
}

Status Writer::write_chunk_record(Bytes records, Bytes last_data, ChunkPlace& place) {
  const std::string_view compression = compression_name(options_.compression);
  const Result<Bytes> packed = compressor_.compress(records);
  if (!packed) return packed.status();
  place.packed_bytes = packed.value().size() + last_data.size();

  const std::uint64_t field_bytes = 8 + 8 + 8 + 4 + 4 + compression.size() + 8;
  place.bytes = kRecordPrefixBytes + field_bytes + place.packed_bytes;
  const bool is_packed = options_.compression != Compression::kNone;
  const bool needs_crc = options_.chunk_crc || !is_packed;
  const std::uint32_t crc = needs_crc ? crc32(records) : 0;
  const std::uint32_t last_crc = crc32(last_data);
  scratch_.clear();
  Encoder encoder(scratch_);
  encoder.record_prefix(Opcode::kChunk, field_bytes + place.packed_bytes);
  encoder.u64(place.start_time);
  encoder.u64(place.end_time);
  encoder.u64(place.unpacked_bytes);
  encoder.u32(options_.chunk_crc ? crc32_join(crc, last_crc, last_data.size()) : 0);
  encoder.text(compression);
  encoder.u64(place.packed_bytes);
  if (Status status = output_.write(scratch_); !status) return status;
  if (is_packed) return output_.write(packed.value());
  if (Status status = output_.write(records, crc); !status) return status;
  return last_data.empty() ? Status() : output_.write(last_data, last_crc);
}

Status Writer::write_message_indexes(ChunkPlace& place) {
  scratch_.clear();
  Encoder encoder(scratch_);
  std::map<ChannelId, std::uint64_t> offsets;
  const auto& messages_of_channel = chunk_.messages_of_channel();
  for (std::size_t channel = 0; channel < messages_of_channel.size(); ++channel) {
    const std::vector<MessageIndexEntry>& messages = messages_of_channel[channel];
    if (messages.empty()) continue;
    const auto id = static_cast<ChannelId>(channel);
    const std::uint64_t list_bytes = messages.size() * 16;
    offsets[id] = output_.offset() + scratch_.size();
    encoder.record_prefix(Opcode::kMessageIndex, 2 + 4 + list_bytes);
    encoder.u16(id);
    encoder.u32(static_cast<std::uint32_t>(list_bytes));
    for (const MessageIndexEntry& message : messages) {
      encoder.u64(message.log_time);
      encoder.u64(message.offset);
    }
  }
  place.message_index_bytes = scratch_.size();
  summary_.add_chunk(place, offsets, compression_name(options_.compression));
  return output_.write(scratch_);
}

}  // namespace flexcast::mcap
