// A recording with two channels, a schema, several chunks, an attachment and metadata, made the same way for many
// tests.
#pragma once

#include <string>
#include <vector>

#include "tests/clients/mcap/contents.h"

namespace flexcast::mcap::test {

struct SampleOptions {
  std::size_t messages = 200;
  std::size_t message_bytes = 300;
};

// What message `i` of the sample is.
inline MessageCopy sample_message(std::size_t i, const SampleOptions& sample) {
  std::string data(sample.message_bytes + i % 7, '\0');
  for (std::size_t k = 0; k < data.size(); ++k) data[k] = static_cast<char>((i * 31 + k / 8) & 0xFF);
  return {.topic = i % 3 == 0 ? "flexcast/status" : "flexcast/frames",
          .sequence = static_cast<std::uint32_t>(i),
          .log_time = 1000 + 10 * i,
          .publish_time = 990 + 10 * i,
          .data = std::move(data)};
}

inline std::vector<MessageCopy> sample_messages(const SampleOptions& sample = {}) {
  std::vector<MessageCopy> messages;
  for (std::size_t i = 0; i < sample.messages; ++i) messages.push_back(sample_message(i, sample));
  return messages;
}

// The attachment comes first, the metadata in the middle of an open chunk.
inline MemorySink sample_recording(const WriterOptions& options, const SampleOptions& sample = {}) {
  MemorySink sink;
  Writer writer(sink, options);
  const SchemaId schema = value_of(writer.add_schema("flexcast::ParticleFrame", "omgidl", "struct ParticleFrame {};"));
  std::map<std::string, ChannelId> channels;
  channels["flexcast/frames"] = value_of(writer.add_channel("flexcast/frames", "cdr", schema, {{"qos", "reliable"}}));
  channels["flexcast/status"] = value_of(writer.add_channel("flexcast/status", "cdr", 0));
  expect_ok(writer.add_attachment("beam.toml", "application/toml", 5, 4, bytes_of("[world]\nname = \"beam\"\n")));
  for (std::size_t i = 0; i < sample.messages; ++i) {
    const MessageCopy message = sample_message(i, sample);
    expect_ok(writer.write_message(channels[message.topic], message.sequence, message.log_time, message.publish_time,
                                   bytes_of(message.data)));
    if (i == sample.messages / 2) expect_ok(writer.add_metadata("gaps", {{"count", "0"}, {"run", "7"}}));
  }
  expect_ok(writer.close());
  return sink;
}

}  // namespace flexcast::mcap::test
