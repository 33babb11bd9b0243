#include "clients/recording/recording.h"

#include <utility>

namespace flexcast::recording {

wire::Result<Recording> Recording::open(const std::string& path) {
  auto file = mcap::MappedFile::open(path);
  if (!file) return wire::Error{file.status().message()};
  Recording recording(path, std::move(file).value());
  if (recording.next() == nullptr && recording.reader_->end().intact_bytes == 0) return wire::Error{recording.trouble_};
  recording.rewind();
  return recording;
}

Recording::Recording(std::string path, mcap::MappedFile file) : path_(std::move(path)), file_(std::move(file)) {
  rewind();
}

void Recording::rewind() {
  reader_ = std::make_unique<mcap::Reader>(file_.bytes());
  rows_.clear();
  trouble_.clear();
}

const RecordedMessage* Recording::next() {
  while (trouble_.empty()) {
    const mcap::Record* record = reader_->next();
    if (record == nullptr) {
      if (reader_->end().ending != mcap::Ending::kComplete) trouble_ = path_ + ": " + reader_->end().message;
      return nullptr;
    }
    const auto* message = std::get_if<mcap::Message>(record);
    if (message != nullptr && accept(*message)) return &message_;
  }
  return nullptr;
}

bool Recording::accept(const mcap::Message& message) {
  auto known = rows_.find(message.channel);
  if (known == rows_.end()) {
    known = rows_.emplace(message.channel, find_row(*reader_->channel(message.channel))).first;
  }
  const wire::TopicRow* row = known->second;
  if (row == nullptr) return false;
  const mcap::SchemaInfo* schema = reader_->schema(reader_->channel(message.channel)->schema);
  if (schema == nullptr || schema->name != row->type_name) {
    trouble_ = path_ + ": the messages of " + row->name + " are not " + std::string(row->type_name);
    return false;
  }
  message_ = {row->id, message.sequence, static_cast<std::int64_t>(message.log_time),
              static_cast<std::int64_t>(message.publish_time), message.data};
  return true;
}

const wire::TopicRow* Recording::find_row(const mcap::ChannelInfo& channel) const {
  for (const wire::TopicRow& row : wire::topic_table()) {
    if (row.name == channel.topic && channel.message_encoding == "cdr") return &row;
  }
  return nullptr;
}

}  // namespace flexcast::recording
