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
  if (const auto* file = std::get_if<Attachment>(&item)) {
    return write_attachment(file->name, file->media_type, file->log_time, file->bytes);
  }
  if (const auto* note = std::get_if<AccountNote>(&item)) return write_note(*note);
  return write_message(std::get<Message>(item));
}

// Behind the frames that came before: of a killed recorder's file no frame is missing that waited in the open chunk.
mcap::Status RecordingFile::write_note(const AccountNote& note) {
  if (mcap::Status status = flush(); !status) return status;
  return add_metadata(account_metadata, to_metadata(note));
}

mcap::Status RecordingFile::write_message(wire::TopicId topic, std::uint32_t sequence, std::int64_t log_time,
                                          std::int64_t publish_time, mcap::Bytes bytes) {
  if (topic == wire::TopicId::frames) note_frame(bytes);
  return writer_.write_message(channels_.at(topic), sequence, static_cast<mcap::Time>(log_time),
                               static_cast<mcap::Time>(publish_time), bytes);
}

mcap::Status RecordingFile::write_attachment(std::string_view name, std::string_view media_type, std::int64_t log_time,
                                             mcap::Bytes bytes) {
  const auto time = static_cast<mcap::Time>(log_time);
  return writer_.add_attachment(name, media_type, time, time, bytes);
}

void RecordingFile::note_frame(mcap::Bytes bytes) {
  auto head = wire::peek_frame_head(bytes);
  if (!head) return;
  head.value().world = {};  // lives as long as the bytes
  while (!recent_.empty() && recent_.front().message < writer_.safe_messages()) recent_.pop_front();
  recent_.push_back({messages(), head.value()});
}

mcap::Result<std::vector<wire::FrameHead>> RecordingFile::cut_back(std::uint64_t room) {
  if (mcap::Status status = writer_.cut_back(room); !status) return status;
  std::vector<wire::FrameHead> cut;
  for (; !recent_.empty() && recent_.back().message >= messages(); recent_.pop_back()) {
    cut.push_back(recent_.back().head);
  }
  return cut;
}

std::vector<wire::FrameHead> RecordingFile::frames_before_first_chunk() const {
  std::vector<wire::FrameHead> heads;
  for (const RecentFrame& frame : recent_) heads.push_back(frame.head);
  return heads;
}

}  // namespace flexcast::record
