// Contents: everything a Reader finds in a file, copied, so that tests can compare it.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clients/mcap/reader.h"
#include "clients/mcap/writer.h"

namespace flexcast::mcap::test {

// The value, or a failed test.
template <class T>
T value_of(Result<T> result) {
  EXPECT_TRUE(result.ok()) << result.status().message();
  return result.ok() ? std::move(result).value() : T();
}

inline void expect_ok(const Status& status) {
  EXPECT_TRUE(status.ok()) << status.message();
}

inline Bytes bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}
inline std::string text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// For the names of tests that run with every compression.
inline std::string compression_label(const testing::TestParamInfo<Compression>& test) {
  return test.param == Compression::kNone ? "none" : std::string(compression_name(test.param));
}

struct MessageCopy {
  std::string topic;
  std::uint32_t sequence = 0;
  Time log_time = 0;
  Time publish_time = 0;
  std::string data;

  bool operator==(const MessageCopy&) const = default;
};

struct AttachmentCopy {
  std::string media_type;
  Time log_time = 0;
  Time create_time = 0;
  std::string data;

  bool operator==(const AttachmentCopy&) const = default;
};

struct Contents {
  std::string profile;
  std::string library;
  std::vector<MessageCopy> messages;
  std::map<std::string, AttachmentCopy> attachments;
  std::map<std::string, TextPairs> metadata;
  std::vector<std::string> compressions;  // of the chunks
  std::vector<std::uint64_t> chunk_offsets;
  std::vector<std::uint64_t> messages_until;  // how many messages there are up to the end of each chunk
  std::uint64_t data_end_offset = 0;
  std::optional<Totals> totals;
  ReadEnd end;
};

inline Totals copy(const Statistics& statistics) {
  Totals totals = {.messages = statistics.messages,
                   .schemas = statistics.schemas,
                   .channels = statistics.channels,
                   .attachments = statistics.attachments,
                   .metadata = statistics.metadata,
                   .chunks = statistics.chunks,
                   .start_time = statistics.start_time,
                   .end_time = statistics.end_time,
                   .messages_of_channel = {}};
  for (std::size_t i = 0; i < statistics.messages_of_channel.size(); ++i) {
    totals.messages_of_channel.insert(statistics.messages_of_channel[i]);
  }
  return totals;
}

inline void add(Contents& contents, const Record& record, const Reader& reader) {
  if (const auto* header = std::get_if<Header>(&record)) {
    contents.profile = header->profile;
    contents.library = header->library;
  } else if (const auto* message = std::get_if<Message>(&record)) {
    contents.messages.push_back({reader.channel(message->channel)->topic, message->sequence, message->log_time,
                                 message->publish_time, text_of(message->data)});
    if (!contents.messages_until.empty()) ++contents.messages_until.back();
  } else if (const auto* attachment = std::get_if<Attachment>(&record)) {
    contents.attachments[std::string(attachment->name)] = {std::string(attachment->media_type), attachment->log_time,
                                                           attachment->create_time, text_of(attachment->data)};
  } else if (const auto* metadata = std::get_if<Metadata>(&record)) {
    contents.metadata[std::string(metadata->name)] = metadata->values.copy();
  } else if (const auto* chunk = std::get_if<Chunk>(&record)) {
    contents.compressions.emplace_back(chunk->compression);
    contents.chunk_offsets.push_back(reader.record_offset());
    contents.messages_until.push_back(contents.messages.size());
  } else if (std::holds_alternative<DataEnd>(record)) {
    contents.data_end_offset = reader.record_offset();
  } else if (const auto* statistics = std::get_if<Statistics>(&record)) {
    contents.totals = copy(*statistics);
  }
}

inline Contents read(Bytes file, ReaderOptions options = {}) {
  Contents contents;
  Reader reader(file, options);
  while (const Record* record = reader.next()) add(contents, *record, reader);
  contents.end = reader.end();
  return contents;
}

}  // namespace flexcast::mcap::test
