// What is in a recording, compared with what a server has put on the network.
#include <map>

#include "idl/wire/idl_text.h"
#include "idl/wire/raw_reader.h"
#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

using mcap::test::text_of;
using test::eventually;
using test::Publisher;
using test::TemporaryFile;

// Takes the bytes of every recorded topic beside the recorder.
class Witness {
 public:
  Witness() {
    for (const wire::TopicRow& row : wire::topic_table()) {
      if (row.recorded) readers_.push_back(wire::RawReader::create(participant_, row).value());
    }
  }

  std::map<std::string, std::vector<std::string>> take() const {
    std::map<std::string, std::vector<std::string>> bytes;
    for (const wire::RawReader& reader : readers_) {
      const auto note = [&](const wire::RawSample& sample) {
        bytes[reader.row().name].push_back(text_of(sample.bytes));
      };
      EXPECT_TRUE(reader.take_raw(note, 10'000).ok());
    }
    return bytes;
  }

 private:
  wire::Participant participant_ = flexcast::test::join_test_domain();
  std::vector<wire::RawReader> readers_;
};

class Compressions : public testing::TestWithParam<mcap::Compression> {};

TEST_P(Compressions, EveryByteOffTheWireIsInTheFile) {
  const Witness witness;
  const Publisher server("beam");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.compression = GetParam();
  auto recorder = test::start(options);
  server.publish_topology();
  server.publish_parameters(1);
  server.publish_event(0);
  server.publish_reply(5);
  server.publish_frames(1000, 0, 199);
  server.publish_event(1);
  test::finish(*recorder, 200);

  const auto sent = witness.take();
  const auto contents = test::read(file);
  for (const char* topic : {"flexcast/scene", "flexcast/topology", "flexcast/parameters", "flexcast/frames",
                            "flexcast/status", "flexcast/replies", "flexcast/events"}) {
    const auto recorded = test::messages_of(contents, topic);
    ASSERT_TRUE(sent.contains(topic)) << topic;
    ASSERT_EQ(recorded.size(), sent.at(topic).size()) << topic;
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      ASSERT_EQ(recorded[i].data, sent.at(topic)[i]) << topic;
      EXPECT_EQ(recorded[i].sequence, i) << topic;
      EXPECT_GT(recorded[i].publish_time, 0u);
      EXPECT_GE(recorded[i].log_time, recorded[i].publish_time);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Recording, Compressions,
                         testing::Values(mcap::Compression::kNone, mcap::Compression::kLz4, mcap::Compression::kZstd),
                         mcap::test::compression_label);

TEST(Recording, CommandsOfOtherClientsAreRecorded) {
  const Publisher server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  const auto participant = flexcast::test::join_test_domain();
  const auto commands = wire::Writer<flexcast_Command>::create(participant).value();
  ASSERT_TRUE(eventually([&] { return commands.matched().current > 0; }));
  wire::Owned<flexcast_Command> command;
  wire::set_string(command->world, "beam");
  ASSERT_TRUE(commands.write(*command).ok());
  server.publish_frames(1000, 0, 0);
  test::finish(*recorder, 1);
  EXPECT_EQ(test::messages_of(test::read(file), "flexcast/commands").size(), 1u);
}

TEST(Recording, EveryRecordedTopicIsAChannelWithTheWholeIdl) {
  const Publisher server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 0, 0);
  test::finish(*recorder, 1);

  const auto mapped = mcap::MappedFile::open(file.path());
  mcap::Reader reader(mapped.value().bytes());
  while (reader.next()) {
  }
  std::map<std::string, const mcap::ChannelInfo*> channels;
  for (const auto& [id, channel] : reader.definitions().channels()) channels[channel.topic] = &channel;
  std::size_t recorded = 0;
  for (const wire::TopicRow& row : wire::topic_table()) {
    ASSERT_EQ(channels.contains(row.name), row.recorded) << row.name;
    if (!row.recorded) continue;
    ++recorded;
    EXPECT_EQ(channels[row.name]->message_encoding, "cdr");
    const mcap::SchemaInfo* schema = reader.schema(channels[row.name]->schema);
    ASSERT_NE(schema, nullptr);
    EXPECT_EQ(schema->name, row.type_name);
    EXPECT_EQ(schema->encoding, "omgidl");
    EXPECT_EQ(schema->data, wire::idl_text());
  }
  EXPECT_EQ(channels.size(), recorded);
}

TEST(Recording, WhatALateJoinerGetsIsRecorded) {
  const Publisher server("beam");
  server.publish_topology();
  server.publish_parameters(3);
  for (std::uint64_t i = 0; i < 5; ++i) server.publish_event(i);
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 37, 40);
  const Report report = test::finish(*recorder, 4);

  const auto contents = test::read(file);
  for (const char* topic : {"flexcast/scene", "flexcast/topology", "flexcast/parameters", "flexcast/status"}) {
    EXPECT_EQ(test::messages_of(contents, topic).size(), 1u) << topic;
  }
  EXPECT_EQ(test::messages_of(contents, "flexcast/events").size(), 5u);
  EXPECT_EQ(test::sequences_of(contents, "flexcast/frames"), (std::vector<std::uint32_t>{37, 38, 39, 40}));
  ASSERT_EQ(report.reception.runs.size(), 1u);
  EXPECT_EQ(report.reception.runs[0].joined_at, 37u);
  EXPECT_EQ(missing_count(report), 0u);
}

TEST(Recording, OtherWorldsOfTheDomainStayOut) {
  const Publisher server("beam"), other("cloth");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  other.publish_frames(7, 100, 120);
  other.publish_event(0);
  server.publish_frames(1000, 0, 9);
  const Report report = test::finish(*recorder, 10);
  EXPECT_EQ(frame_count(report), 10u);
  EXPECT_EQ(missing_count(report), 0u);
  const auto contents = test::read(file);
  EXPECT_EQ(test::messages_of(contents, "flexcast/frames").size(), 10u);
  EXPECT_EQ(test::messages_of(contents, "flexcast/scene").size(), 1u);
  EXPECT_EQ(test::messages_of(contents, "flexcast/events").size(), 0u);
  EXPECT_EQ(contents.messages.size(), report.messages);
}

TEST(Recording, TheSceneAndItsMeshesAreAttachedOncePerContent) {
  const Publisher server("beam", "first = 1\n");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_scene("second = 2\n", "mesh");
  server.publish_scene("second = 2\n", "mesh");
  server.publish_frames(1000, 0, 0);
  test::finish(*recorder, 1);

  const auto mapped = mcap::MappedFile::open(file.path());
  mcap::Reader reader(mapped.value().bytes());
  std::vector<std::string> attached;
  while (const mcap::Record* record = reader.next()) {
    const auto* attachment = std::get_if<mcap::Attachment>(record);
    if (!attachment) continue;
    EXPECT_FALSE(reader.in_chunk());
    attached.push_back(std::string(attachment->name) + ": " + text_of(attachment->data));
  }
  EXPECT_EQ(attached,
            (std::vector<std::string>{"drop.toml: first = 1\n", "drop.toml: second = 2\n", "meshes/ball.msh: mesh"}));
}

}  // namespace
}  // namespace flexcast::record
