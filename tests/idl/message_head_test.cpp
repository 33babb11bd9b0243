#include "idl/wire/message_head.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "idl/wire/raw_reader.h"
#include "idl/wire/writer.h"
#include "tests/idl/samples.h"
#include "tests/support/network.h"

namespace flexcast::wire {
namespace {

using Bytes = std::vector<std::byte>;

// A filled sample as it comes off the wire.
template <class T>
Bytes serialised() {
  const wire::Participant participant = test::join_test_domain();
  const auto reader = wire::RawReader::create(participant, wire::topic_of<T>()).value();
  const auto writer = wire::Writer<T>::create(participant).value();
  wire::Owned<T> sample;
  test::fill(*sample);
  EXPECT_TRUE(writer.write(*sample).ok());
  Bytes bytes;
  const auto taken =
      reader.take_raw([&](const wire::RawSample& raw) { bytes.assign(raw.bytes.begin(), raw.bytes.end()); });
  EXPECT_TRUE(taken.ok());
  return bytes;
}

template <class T>
class MessageHead : public testing::Test {};

using AllTypes = testing::Types<flexcast_SceneInfo, flexcast_Topology, flexcast_ParameterSet, flexcast_ParticleFrame,
                                flexcast_Status, flexcast_Command, flexcast_Reply, flexcast_Event,
                                flexcast_RecorderInfo, flexcast_RecorderCommand>;
TYPED_TEST_SUITE(MessageHead, AllTypes);

TYPED_TEST(MessageHead, GivesTheWorldOfEveryTopic) {
  EXPECT_EQ(peek_world(wire::topic_of<TypeParam>().id, serialised<TypeParam>()), "beam");
}

TYPED_TEST(MessageHead, GivesNothingOfBytesThatEndBeforeTheNameDoes) {
  const Bytes bytes = serialised<TypeParam>();
  const wire::TopicId topic = wire::topic_of<TypeParam>().id;
  const auto world = peek_world(topic, bytes);
  ASSERT_TRUE(world);
  const std::size_t end =
      static_cast<std::size_t>(world->data() - reinterpret_cast<const char*>(bytes.data())) + world->size() + 1;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_EQ(peek_world(topic, cut).has_value(), size >= end) << size;
  }
}

TYPED_TEST(MessageHead, GivesNothingOfANameThatIsLongerThanTheSample) {
  const Bytes bytes = serialised<TypeParam>();
  const wire::TopicId topic = wire::topic_of<TypeParam>().id;
  const std::size_t at =
      static_cast<std::size_t>(peek_world(topic, bytes)->data() - reinterpret_cast<const char*>(bytes.data())) - 4;
  for (const std::uint32_t length : {0u, static_cast<std::uint32_t>(bytes.size()), 0x7fffffffu, 0xffffffffu}) {
    Bytes hostile = bytes;
    std::memcpy(hostile.data() + at, &length, sizeof length);
    EXPECT_FALSE(peek_world(topic, hostile)) << length;
  }
}

TEST(MessageHeads, AreReadInBothByteOrdersAndInNoOtherEncoding) {
  const std::string_view big("\0\0\0\0\0\0\0\5beam\0", 13);
  EXPECT_EQ(peek_world(wire::TopicId::commands, std::as_bytes(std::span(big))), "beam");
  Bytes bytes = serialised<flexcast_Command>();
  bytes[1] = std::byte{7};  // XCDR2
  EXPECT_FALSE(peek_world(wire::TopicId::commands, bytes));
}

}  // namespace
}  // namespace flexcast::wire
