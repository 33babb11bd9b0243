#include "clients/recording/recording.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "clients/mcap/file_sink.h"
#include "clients/mcap/writer.h"

namespace flexcast::recording {
namespace {

namespace fs = std::filesystem;

class RecordingTest : public testing::Test {
 protected:
  ~RecordingTest() override { fs::remove(path_); }

  // Two messages of the topic, and one of somebody else's between them.
  void write_file(const std::string& topic, const std::string& type, bool close = true) {
    auto sink = mcap::FileSink::create(path_, {.replace_existing = true}).value();
    mcap::Writer writer(*sink);
    const auto schema = writer.add_schema(type, "omgidl", std::string_view("text")).value();
    const auto channel = writer.add_channel(topic, "cdr", schema).value();
    const auto other = writer.add_channel("somebody/else", "json", 0).value();
    const std::array bytes{std::byte{1}, std::byte{2}};
    EXPECT_TRUE(writer.write_message(channel, 7, 20, 10, bytes).ok());
    EXPECT_TRUE(writer.write_message(other, 0, 21, 11, bytes).ok());
    EXPECT_TRUE(writer.write_message(channel, 8, 22, 12, bytes).ok());
    EXPECT_TRUE((close ? writer.close() : writer.flush()).ok());
    EXPECT_TRUE(sink->close().ok());
  }

  const std::string path_ =
      (fs::temp_directory_path() / ("recording_test_" + std::to_string(getpid()) + ".mcap")).string();
};

TEST_F(RecordingTest, GivesTheMessagesOfOurTopicsInTheOrderOfTheFileAndAgain) {
  write_file("flexcast/frames", "flexcast::ParticleFrame");
  auto recording = Recording::open(path_);
  ASSERT_TRUE(recording.ok());
  for (int pass = 0; pass < 2; ++pass) {
    for (const std::uint32_t sequence : {7u, 8u}) {
      const RecordedMessage* message = recording.value().next();
      ASSERT_NE(message, nullptr);
      EXPECT_EQ(message->topic, wire::TopicId::frames);
      EXPECT_EQ(message->sequence, sequence);
      EXPECT_EQ(message->log_time - message->publish_time, 10);
      EXPECT_EQ(message->bytes.size(), 2u);
    }
    EXPECT_EQ(recording.value().next(), nullptr);
    EXPECT_EQ(recording.value().trouble(), "");
    recording.value().rewind();
  }
}

TEST_F(RecordingTest, AFileWithoutItsEndIsReadAsFarAsItGoesAndSaysSo) {
  write_file("flexcast/frames", "flexcast::ParticleFrame", false);
  auto recording = Recording::open(path_);
  ASSERT_TRUE(recording.ok());
  EXPECT_NE(recording.value().next(), nullptr);
  EXPECT_NE(recording.value().next(), nullptr);
  EXPECT_EQ(recording.value().next(), nullptr);
  EXPECT_NE(recording.value().trouble().find(path_ + ": truncated"), std::string::npos) << recording.value().trouble();
}

TEST_F(RecordingTest, ATopicOfOursWithAnotherTypeIsAnError) {
  write_file("flexcast/frames", "flexcast::Status");
  const auto recording = Recording::open(path_);
  ASSERT_FALSE(recording.ok());
  EXPECT_NE(recording.error().message.find("flexcast/frames are not flexcast::ParticleFrame"), std::string::npos);
}

TEST_F(RecordingTest, WhatIsNoRecordingIsAnErrorThatNamesTheFile) {
  EXPECT_NE(Recording::open("/nonexistent.mcap").error().message.find("/nonexistent.mcap"), std::string::npos);
  const std::string folder = fs::temp_directory_path().string();
  EXPECT_FALSE(Recording::open(folder).ok());
  EXPECT_NE(Recording::open(FLEXCAST_SOURCE_DIR "/CMakeLists.txt").error().message.find("CMakeLists.txt"),
            std::string::npos);
}

}  // namespace
}  // namespace flexcast::recording
