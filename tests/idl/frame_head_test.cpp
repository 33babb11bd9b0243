#include "idl/wire/frame_head.h"

#include <gtest/gtest.h>

#include <vector>

#include "idl/wire/raw_reader.h"
#include "idl/wire/writer.h"
#include "tests/idl/samples.h"
#include "tests/support/network.h"

namespace flexcast::wire {
namespace {

std::vector<std::byte> serialised(const flexcast_ParticleFrame& frame) {
  const Participant participant = test::join_test_domain();
  const auto writer = Writer<flexcast_ParticleFrame>::create(participant).value();
  const auto reader = RawReader::create(participant, topic(TopicId::frames)).value();
  EXPECT_TRUE(writer.write(frame).ok());
  std::vector<std::byte> bytes;
  EXPECT_TRUE(reader.take_raw([&](const RawSample& s) { bytes.assign(s.bytes.begin(), s.bytes.end()); }).ok());
  return bytes;
}

TEST(FrameHead, LiesAtFixedOffsetsOfTheSerialisedFrame) {
  Owned<flexcast_ParticleFrame> frame;
  test::fill(*frame);
  const auto bytes = serialised(*frame);
  const auto head = peek_frame_head(bytes);
  ASSERT_TRUE(head.ok());
  EXPECT_EQ(head.value().run_id, frame->run_id);
  EXPECT_EQ(head.value().frame, frame->frame);
  EXPECT_EQ(head.value().step, frame->step);
  EXPECT_EQ(head.value().time, frame->time);
  EXPECT_EQ(head.value().parameter_revision, frame->parameter_revision);
  EXPECT_EQ(head.value().topology_revision, frame->topology_revision);
  EXPECT_EQ(head.value().state_hash, frame->state_hash);
  EXPECT_EQ(head.value().chunk, frame->chunk);
  EXPECT_EQ(head.value().chunks, frame->chunks);
  EXPECT_EQ(head.value().first, frame->first);
  EXPECT_EQ(head.value().total, frame->total);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(head.value().bounds[i], frame->bounds[i]);
  EXPECT_EQ(head.value().world, "beam");
}

TEST(FrameHead, PositionsFollowTheNameOfTheWorld) {
  Owned<flexcast_ParticleFrame> frame;
  test::fill(*frame);
  const auto bytes = serialised(*frame);
  std::size_t at = frame_offset::world + std::string_view("beam").size() + 1;
  at += (4 - at % 4) % 4;
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + at, 4);
  ASSERT_EQ(length, frame->positions._length);
  EXPECT_EQ(std::memcmp(bytes.data() + at + 4, frame->positions._buffer, 4 * length), 0);
}

TEST(FrameHead, IsRefusedWhenTheBytesEndEarlyOrAreOfAnotherEncoding) {
  Owned<flexcast_ParticleFrame> frame;
  test::fill(*frame);
  auto bytes = serialised(*frame);
  const std::size_t end_of_name = frame_offset::world + 5;
  for (std::size_t size = 0; size < end_of_name; ++size)
    EXPECT_FALSE(peek_frame_head(std::span(bytes).first(size)).ok()) << size;
  EXPECT_TRUE(peek_frame_head(std::span(bytes).first(end_of_name)).ok());
  bytes[1] = std::byte{0};
  EXPECT_FALSE(peek_frame_head(bytes).ok());
}

}  // namespace
}  // namespace flexcast::wire
