#include "tests/system/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "clients/mcap/mapped_file.h"
#include "idl/wire/topics.h"

namespace flexcast::test {
namespace {

std::string_view schema_of(const mcap::Reader& reader, const mcap::ChannelInfo& channel) {
  const mcap::SchemaInfo* schema = reader.schema(channel.schema);
  if (schema == nullptr || schema->encoding != "omgidl" || channel.message_encoding != "cdr") return "";
  return schema->name;
}

void add_message(Recording& recording, wire::TopicId topic, const mcap::Message& message) {
  using wire::TopicId;
  const Bytes bytes = message.data;
  switch (topic) {
    case TopicId::scene:
      return recording.scenes.push_back(decode_scene(bytes));
    case TopicId::topology:
      return recording.topologies.push_back(decode_topology(bytes));
    case TopicId::parameters:
      return recording.parameter_sets.push_back(decode_parameter_set(bytes));
    case TopicId::frames:
      return recording.frames.push_back(decode_frame(bytes, message.sequence));
    case TopicId::status:
      return recording.statuses.push_back(decode_status(bytes));
    case TopicId::commands:
      return recording.commands.push_back(decode_command(bytes));
    case TopicId::replies:
      return recording.replies.push_back(decode_reply(bytes));
    case TopicId::events:
      return recording.events.push_back(decode_event(bytes));
    case TopicId::recorders:
    case TopicId::recorder_commands:
      break;
  }
  throw std::runtime_error("a message of a topic that is not recorded");
}

void add(Recording& recording, const mcap::Reader& reader, const mcap::Message& message) {
  const mcap::ChannelInfo& channel = *reader.channel(message.channel);
  for (const wire::TopicRow& row : wire::topic_table()) {
    if (row.name != channel.topic) continue;
    if (schema_of(reader, channel) != row.type_name) throw std::runtime_error("wrong schema of " + channel.topic);
    ++recording.messages[channel.topic];
    return add_message(recording, row.id, message);
  }
  throw std::runtime_error("unknown topic " + channel.topic);
}

}  // namespace

Recording read_recording(const std::filesystem::path& path) {
  const auto file = mcap::MappedFile::open(path);
  if (!file) throw std::runtime_error(file.status().message());
  Recording recording;
  mcap::Reader reader(file.value().bytes());
  while (const mcap::Record* record = reader.next()) {
    if (const auto* message = std::get_if<mcap::Message>(record)) add(recording, reader, *message);
    if (const auto* attachment = std::get_if<mcap::Attachment>(record)) {
      recording.attachments[std::string(attachment->name)].assign(
          reinterpret_cast<const char*>(attachment->data.data()), attachment->data.size());
    }
    if (const auto* metadata = std::get_if<mcap::Metadata>(record)) {
      recording.metadata[std::string(metadata->name)] = metadata->values.copy();
    }
    if (const auto* footer = std::get_if<mcap::Footer>(record)) recording.has_footer = footer->summary_start > 0;
  }
  recording.end = reader.end();
  return recording;
}

std::vector<std::uint64_t> Recording::run_ids() const {
  std::vector<std::uint64_t> ids;
  for (const FrameMessage& frame : frames) {
    if (std::find(ids.begin(), ids.end(), frame.run_id) == ids.end()) ids.push_back(frame.run_id);
  }
  return ids;
}

std::vector<FrameMessage> Recording::frames_of(std::uint64_t run_id) const {
  std::vector<FrameMessage> chosen;
  std::copy_if(frames.begin(), frames.end(), std::back_inserter(chosen),
               [&](const FrameMessage& frame) { return frame.run_id == run_id; });
  return chosen;
}

std::vector<EventMessage> Recording::command_events(flexcast_CommandKind command) const {
  std::vector<EventMessage> chosen;
  std::copy_if(events.begin(), events.end(), std::back_inserter(chosen), [&](const EventMessage& event) {
    return event.kind == flexcast_EVENT_COMMAND && event.command_kind == command;
  });
  return chosen;
}

void expect_complete(const Recording& recording) {
  EXPECT_EQ(recording.end.ending, mcap::Ending::kComplete) << recording.end.message;
  EXPECT_TRUE(recording.has_footer);
}

void expect_contiguous(const std::vector<FrameMessage>& frames, std::uint64_t first) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    ASSERT_EQ(frames[i].frame, first + i);
    ASSERT_EQ(frames[i].sequence, first + i);
    ASSERT_EQ(frames[i].chunks, 1U);
  }
}

}  // namespace flexcast::test
