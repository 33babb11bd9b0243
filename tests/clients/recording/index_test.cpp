#include "clients/recording/index.h"

#include <gtest/gtest.h>

#include "idl/wire/decode.h"
#include "tests/support/recording_maker.h"

namespace flexcast::recording {
namespace {

using flexcast::test::RecordingMaker;
using flexcast::test::TemporaryFolder;

class IndexTest : public testing::Test {
 protected:
  Recording open() { return Recording::open(path_).value(); }

  wire::TopicId topic_at(Recording& recording, std::uint64_t ordinal) {
    recording.seek(ordinal);
    return recording.next()->topic;
  }

  wire::FrameHead head_at(Recording& recording, std::uint64_t ordinal) {
    recording.seek(ordinal);
    auto head = wire::peek_frame_head(recording.next()->bytes).value();
    head.world = {};
    return head;
  }

  // Scene, two bodies, parameters: what every run begins with.
  static constexpr std::uint64_t before_frames = 5;

  const TemporaryFolder folder_;
  const std::string path_ = folder_.path("run.mcap");
};

TEST_F(IndexTest, FramesAreWhereItSays) {
  RecordingMaker maker(path_, 2000);  // many chunks in the file
  maker.add_run(100, 50, 2);
  maker.add_run(200, 3);
  maker.close();
  Recording recording = open();
  const auto index = Index::make(recording, {}).value();
  EXPECT_EQ(index.world(), "beam");
  EXPECT_EQ(index.trouble(), "");
  ASSERT_EQ(index.runs().size(), 2U);
  EXPECT_EQ(index.runs()[1].run_id, 200U);
  EXPECT_EQ(index.runs()[1].begin, 50U);
  EXPECT_EQ(index.runs()[1].end, 53U);
  // Backwards, so that every one is a jump.
  for (std::size_t i = index.frames().size(); i-- > 0;) {
    const FrameEntry& entry = index.frames()[i];
    const auto head = head_at(recording, entry.first);
    EXPECT_EQ(head.frame, entry.number);
    EXPECT_EQ(head.time, entry.time);
    EXPECT_EQ(head.run_id, i < 50 ? 100U : 200U);
    EXPECT_EQ(head_at(recording, entry.last).chunk, i < 50 ? 1U : 0U);
  }
}

TEST_F(IndexTest, TheLargestFrameCountsWithAllItsChunks) {
  RecordingMaker maker(path_);
  maker.add_run(100, 1);
  maker.add_frame(100, 1, 1, 2);
  maker.close();
  Recording recording = open();
  const auto index = Index::make(recording, {}).value();
  recording.seek(index.frames()[1].first);
  std::size_t bytes = recording.next()->bytes.size();
  bytes += recording.next()->bytes.size();
  EXPECT_EQ(index.frame_bytes(), bytes);
}

TEST_F(IndexTest, InForceIsTheNewestOfTheRunWithTheRevisionsOfTheFrame) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2);         // 0 scene, 1 2 topology, 3 parameters, 4 event, 5 6 frames
  maker.add_parameters(100, 2);  // 7
  maker.add_frame(100, 2, 2);    // 8
  maker.add_run(200, 1);         // 9 scene, 10 11 topology, 12 parameters, 13 event, 14 frame
  maker.close();
  Recording recording = open();
  const auto index = Index::make(recording, {}).value();
  using Ordinals = std::vector<std::uint64_t>;
  EXPECT_EQ(index.find_in_force(head_at(recording, 6), 6), (Ordinals{0, 1, 2, 3}));
  EXPECT_EQ(index.find_in_force(head_at(recording, 8), 8), (Ordinals{0, 1, 2, 7}));
  EXPECT_EQ(index.find_in_force(head_at(recording, 14), 14), (Ordinals{9, 10, 11, 12}));
}

TEST_F(IndexTest, ParametersThatCameBeforeTheirTimeAreNotInForceYet) {
  RecordingMaker maker(path_);
  maker.add_run(100, 1);         // 3 parameters, 5 frame
  maker.add_parameters(100, 2);  // 6
  maker.add_frame(100, 1, 1);    // 7
  maker.close();
  Recording recording = open();
  const auto index = Index::make(recording, {}).value();
  EXPECT_EQ(index.find_in_force(head_at(recording, 7), 7).back(), 3U);
}

TEST_F(IndexTest, WhatCameAfterItsFrameIsInForceThereToo) {
  RecordingMaker maker(path_);
  maker.add_run(100, 1);       // 0 to 5
  maker.add_frame(200, 0, 1);  // 6
  maker.add_scene(200);        // 7
  maker.add_topology(200);     // 8 9
  maker.add_parameters(200, 1);
  maker.close();
  Recording recording = open();
  const auto index = Index::make(recording, {}).value();
  EXPECT_EQ(index.find_in_force(head_at(recording, 6), 6), (std::vector<std::uint64_t>{7, 8, 9, 10}));
}

TEST_F(IndexTest, ATruncatedRecordingIsIndexedAsFarAsItGoes) {
  RecordingMaker maker(path_);
  maker.add_run(100, 4);
  maker.cut();
  Recording recording = open();
  const auto index = Index::make(recording, {}).value();
  EXPECT_EQ(index.frames().size(), 4U);
  EXPECT_NE(index.trouble().find("truncated"), std::string::npos) << index.trouble();
}

TEST_F(IndexTest, ARecordingWithoutFramesIsAnError) {
  RecordingMaker maker(path_);
  maker.add_scene(100);
  maker.close();
  Recording recording = open();
  const auto index = Index::make(recording, {});
  ASSERT_FALSE(index.ok());
  EXPECT_EQ(index.error().message, path_ + ": there is no frame in it");
}

TEST_F(IndexTest, ASeekGoesToAnyMessageFromAnywhere) {
  RecordingMaker maker(path_, 500);
  maker.add_run(100, 400);
  maker.close();
  Recording recording = open();
  std::vector<std::uint32_t> sequences;
  while (const RecordedMessage* message = recording.next()) sequences.push_back(message->sequence);
  ASSERT_EQ(sequences.size(), 405U);
  EXPECT_EQ(recording.trouble(), "");
  for (std::size_t i = 0; i < 1000; ++i) {
    const std::size_t ordinal = i * 7919 % sequences.size();
    recording.seek(ordinal);
    ASSERT_EQ(recording.ordinal(), ordinal);
    ASSERT_EQ(recording.next()->sequence, sequences[ordinal]);
    if (i == 500) recording.rewind();
  }
  recording.seek(1000);
  EXPECT_EQ(recording.next(), nullptr);
  EXPECT_EQ(recording.trouble(), "");
}

}  // namespace
}  // namespace flexcast::recording
