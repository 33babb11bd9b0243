#include "clients/recording/recording.h"

#include <algorithm>
#include <utility>

namespace flexcast::recording {
namespace {

constexpr std::uint64_t mark_distance = 64 * 1024;  // bytes of the file

}  // namespace

wire::Result<Recording> Recording::open(const std::string& path) {
  auto file = mcap::MappedFile::open(path);
  if (!file) return wire::Error{file.status().message()};
  Recording recording(path, std::move(file).value());
  if (recording.next() == nullptr && recording.reader_->end().intact_bytes == 0) return wire::Error{recording.trouble_};
  recording.rewind();
  return recording;
}

Recording::Recording(std::string path, mcap::MappedFile file) : path_(std::move(path)), file_(std::move(file)) {
  reader_ = std::make_unique<mcap::Reader>(file_.bytes());
}

void Recording::seek(std::uint64_t ordinal) {
  const auto after = std::upper_bound(marks_.begin(), marks_.end(), ordinal,
                                      [](std::uint64_t wanted, const Mark& mark) { return wanted < mark.ordinal; });
  const Mark mark = after == marks_.begin() ? Mark{} : *std::prev(after);
  trouble_.clear();
  if (ordinal < ordinal_ || mark.ordinal > ordinal_ || ordinal == 0) {
    reader_->seek(mark.offset);
    ordinal_ = mark.ordinal;
  }
  while (ordinal_ < ordinal && next() != nullptr) {
  }
}

const RecordedMessage* Recording::next() {
  while (trouble_.empty()) {
    const mcap::Record* record = reader_->next();
    if (record == nullptr) {
      if (reader_->end().ending != mcap::Ending::kComplete) trouble_ = path_ + ": " + reader_->end().message;
      return nullptr;
    }
    const auto* message = std::get_if<mcap::Message>(record);
    if (message == nullptr || !accept(*message)) continue;
    note_mark();
    ++ordinal_;
    return &message_;
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

// The message that was read is the first of its chunk when no mark has that chunk and one reads in the order of the
// file.
void Recording::note_mark() {
  const std::uint64_t offset = reader_->record_offset();
  const bool is_new = marks_.empty() ? ordinal_ > 0 : offset >= marks_.back().offset + mark_distance;
  if (is_new && offset != chunk_) marks_.push_back({ordinal_, offset});
  chunk_ = offset;
}

const wire::TopicRow* Recording::find_row(const mcap::ChannelInfo& channel) const {
  for (const wire::TopicRow& row : wire::topic_table()) {
    if (row.name == channel.topic && channel.message_encoding == "cdr") return &row;
  }
  return nullptr;
}

}  // namespace flexcast::recording
