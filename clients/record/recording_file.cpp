#include "clients/record/recording_file.h"

#include "idl/wire/idl_text.h"

namespace flexcast::record {

mcap::Result<std::unique_ptr<RecordingFile>> RecordingFile::create(mcap::ByteSink& sink,
                                                                   mcap::Compression compression) {
  std::unique_ptr<RecordingFile> file(new RecordingFile(sink, compression));
  if (mcap::Status status = file->add_channels(); !status) return status;
  return file;
}

mcap::Status RecordingFile::add_channels() {
  for (const wire::TopicRow& row : wire::topic_table()) {
    if (!row.recorded) continue;
    const auto schema = writer_.add_schema(row.type_name, "omgidl", wire::idl_text());
    if (!schema) return schema.status();
    const auto channel = writer_.add_channel(row.name, "cdr", schema.value());
    if (!channel) return channel.status();
    channels_[row.id] = channel.value();
  }
  return {};
}

mcap::Status RecordingFile::write(const Item& item) {
  if (const auto* attachment = std::get_if<Attachment>(&item)) {
    const auto time = static_cast<mcap::Time>(attachment->log_time);
    return writer_.add_attachment(attachment->name, attachment->media_type, time, time, attachment->bytes);
  }
  const auto& message = std::get<Message>(item);
  return writer_.write_message(channels_.at(message.topic), message.sequence, static_cast<mcap::Time>(message.log_time),
                               static_cast<mcap::Time>(message.publish_time), message.bytes);
}

}  // namespace flexcast::record
