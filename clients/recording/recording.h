// Recording: goes through the messages of a recording of ours in the order of the file, by topic.
//
//   auto recording = Recording::open("run.mcap");
//   while (const RecordedMessage* message = recording.value().next()) {
//     if (message->topic == wire::TopicId::events) apply(*wire::decode<flexcast_Event>(message->bytes).value());
//   }
//   if (!recording.value().trouble().empty()) warn(recording.value().trouble());
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/mcap/mapped_file.h"
#include "clients/mcap/reader.h"
#include "idl/wire/result.h"
#include "idl/wire/topics.h"

namespace flexcast::recording {

struct RecordedMessage {
  wire::TopicId topic = wire::TopicId::frames;
  std::uint32_t sequence = 0;
  std::int64_t log_time = 0;  // ns since 1970: of receipt
  std::int64_t publish_time = 0;
  std::span<const std::byte> bytes;  // CDR with its header; valid until the next call
};

class Recording {
 public:
  // Errors name the file: not there, no MCAP file, no recording of ours.
  static wire::Result<Recording> open(const std::string& path);

  // The next message of a topic of ours, or null at the end. Channels that are not ours are passed over; one of our
  // topics with another type ends the reading.
  const RecordedMessage* next();

  // From the first message on again.
  void rewind() { seek(0); }

  // The message that next() gives next has this number: 0, 1, 2, ... in the order of the file. Quick where next() has
  // been before; from there on it reads its way.
  void seek(std::uint64_t ordinal);
  std::uint64_t ordinal() const { return ordinal_; }

  // After the end: "" if the file is complete, else one sentence that names the file and says why it ends there.
  const std::string& trouble() const { return trouble_; }

  const std::string& path() const { return path_; }

 private:
  // A place in the file from which reading can begin: a chunk, or a message outside of chunks.
  struct Mark {
    std::uint64_t ordinal = 0;  // of the first message there
    std::uint64_t offset = 0;
  };

  Recording(std::string path, mcap::MappedFile file);
  bool accept(const mcap::Message& message);
  void note_mark();
  const wire::TopicRow* find_row(const mcap::ChannelInfo& channel) const;

  std::string path_;
  mcap::MappedFile file_;
  std::unique_ptr<mcap::Reader> reader_;
  std::map<mcap::ChannelId, const wire::TopicRow*> rows_;  // null: not ours
  std::vector<Mark> marks_;  // ordered; so many bytes apart that a long file has few of them
  std::uint64_t ordinal_ = 0;
  std::uint64_t chunk_ = 0;  // offset of the last message's chunk
  RecordedMessage message_;
  std::string trouble_;
};

}  // namespace flexcast::recording
