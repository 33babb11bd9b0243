#include "clients/record/recording_copy.h"

namespace flexcast::record {
namespace {

std::optional<wire::TopicId> find_topic(const mcap::ChannelInfo& channel, const mcap::SchemaInfo* schema) {
  for (const wire::TopicRow& row : wire::topic_table()) {
    const bool is_ours = row.name == channel.topic && channel.message_encoding == "cdr";
    if (is_ours && schema != nullptr && schema->name == row.type_name) return row.id;
  }
  return std::nullopt;
}

}  // namespace

mcap::Compression find_compression(mcap::Bytes file) {
  mcap::Reader reader(file);
  while (const mcap::Record* record = reader.next()) {
    const auto* chunk = std::get_if<mcap::Chunk>(record);
    if (chunk == nullptr) continue;
    for (const auto compression : {mcap::Compression::kNone, mcap::Compression::kLz4, mcap::Compression::kZstd}) {
      if (mcap::compression_name(compression) == chunk->compression) return compression;
    }
  }
  return mcap::Compression::kLz4;
}

mcap::Status RecordingCopy::take(const mcap::Reader& reader, const mcap::Record& record) {
  if (const auto* message = std::get_if<mcap::Message>(&record)) return take_message(reader, *message);
  if (const auto* channel = std::get_if<mcap::Channel>(&record)) {
    return reader.in_summary() ? mcap::Status() : find_channel(reader, channel->id).status();
  }
  if (const auto* file = std::get_if<mcap::Attachment>(&record)) {
    return writer_.add_attachment(file->name, file->media_type, file->log_time, file->create_time, file->data);
  }
  const auto* metadata = std::get_if<mcap::Metadata>(&record);
  if (metadata == nullptr) return {};
  if (metadata->name == account_metadata) ledger_.note(account_of(metadata->values.copy()));
  if (metadata->name.starts_with("flexcast.")) return {};
  return writer_.add_metadata(metadata->name, metadata->values.copy());
}

mcap::Status RecordingCopy::take_message(const mcap::Reader& reader, const mcap::Message& message) {
  const auto channel = find_channel(reader, message.channel);
  if (!channel) return channel.status();
  const auto& [id, topic] = channel.value();
  if (topic) ledger_.note(*topic, static_cast<std::int64_t>(message.log_time), message.data);
  return writer_.write_message(id, message.sequence, message.log_time, message.publish_time, message.data);
}

mcap::Result<RecordingCopy::Channel> RecordingCopy::find_channel(const mcap::Reader& reader, mcap::ChannelId id) {
  const mcap::ChannelInfo& info = *reader.channel(id);
  if (const auto known = channels_.find(info.topic); known != channels_.end()) return known->second;
  auto made = make_channel(reader, info);
  if (made) channels_.emplace(info.topic, made.value());
  return made;
}

mcap::Result<RecordingCopy::Channel> RecordingCopy::make_channel(const mcap::Reader& reader,
                                                                 const mcap::ChannelInfo& channel) {
  const mcap::SchemaInfo* schema = reader.schema(channel.schema);
  const auto schema_id = find_schema(schema);
  if (!schema_id) return schema_id.status();
  const auto id = writer_.add_channel(channel.topic, channel.message_encoding, schema_id.value(), channel.metadata);
  if (!id) return id.status();
  return Channel{id.value(), find_topic(channel, schema)};
}

mcap::Result<mcap::SchemaId> RecordingCopy::find_schema(const mcap::SchemaInfo* schema) {
  if (schema == nullptr) return mcap::SchemaId{0};
  const std::pair key{schema->name, schema->data};
  if (const auto known = schemas_.find(key); known != schemas_.end()) return known->second;
  const auto id = writer_.add_schema(schema->name, schema->encoding, std::string_view(schema->data));
  if (id) schemas_[key] = id.value();
  return id;
}

mcap::Status RecordingCopy::complete(Report& report) {
  if (auto status = writer_.add_metadata("flexcast.recording", recording_metadata(report)); !status) return status;
  if (auto status = writer_.add_metadata("flexcast.gaps", gaps_metadata(report)); !status) return status;
  report.messages = writer_.totals().messages;
  if (auto status = writer_.close(); !status) return status;
  report.bytes = writer_.bytes_written();
  return {};
}

}  // namespace flexcast::record
