// What the receiving thread hands to the file's thread: a message off the wire, a file that becomes an attachment, or
// what it knows of frames that are not there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "clients/record/account_note.h"
#include "idl/wire/raw_reader.h"
#include "idl/wire/topics.h"

namespace flexcast::record {

struct Message {
  wire::TopicId topic = wire::TopicId::frames;
  std::uint32_t sequence = 0;
  std::int64_t log_time = 0;  // ns since 1970
  std::int64_t publish_time = 0;
  wire::SampleBytes bytes;  // CDR with its header
};

struct Attachment {
  std::string name;
  std::string media_type;
  std::int64_t log_time = 0;  // ns since 1970
  std::vector<std::byte> bytes;
};

inline Message make_message(wire::TopicId topic, std::uint32_t sequence, const wire::RawSample& sample) {
  return {topic, sequence, sample.receive_time, sample.info.source_time, sample.shared};
}

using Item = std::variant<Message, Attachment, AccountNote>;

// What comes with it beside the object itself.
inline std::size_t payload_bytes(const Item& item) {
  if (const auto* message = std::get_if<Message>(&item)) return message->bytes.size();
  if (const auto* file = std::get_if<Attachment>(&item)) return file->bytes.size();
  const auto& note = std::get<AccountNote>(item);
  return 8 * note.watched.size() + sizeof(Pause) * (note.paused.size() + note.dropped.size());
}

}  // namespace flexcast::record
