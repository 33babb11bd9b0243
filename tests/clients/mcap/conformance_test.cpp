// The inputs OneMessage and TenMessages of the format's published conformance suite: the bytes must be the very same.
#include "tests/clients/mcap/contents.h"
#include "tests/support/sha256.h"

namespace flexcast::mcap::test {
namespace {

using flexcast::test::sha256;

struct Input {
  std::uint32_t sequence;
  Time log_time;
  Time publish_time;
};

std::string digest_of(const std::vector<Input>& messages) {
  constexpr std::byte kSchema[] = {std::byte{4}, std::byte{5}, std::byte{6}};
  constexpr std::byte kData[] = {std::byte{1}, std::byte{2}, std::byte{3}};
  MemorySink sink;
  Writer writer(sink, {.profile = "", .library = "", .compression = Compression::kNone});
  const SchemaId schema = value_of(writer.add_schema("Example", "c", Bytes(kSchema)));
  const ChannelId channel = value_of(writer.add_channel("example", "a", schema, {{"foo", "bar"}}));
  for (const Input& message : messages) {
    expect_ok(writer.write_message(channel, message.sequence, message.log_time, message.publish_time, kData));
  }
  expect_ok(writer.close());
  return sha256(sink.bytes());
}

TEST(McapConformance, TheTestsOwnSha256AgreesWithTheStandard) {
  EXPECT_EQ(sha256(bytes_of("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(McapConformance, OneMessageIsWrittenAsPublished) {
  EXPECT_EQ(digest_of({{10, 2, 1}}), "c2dc0d4ef3f1ee615eccc5753b4c401878865d05fb58c12aa7086c3e5e147165");
}

TEST(McapConformance, TenMessagesOutOfOrderAreWrittenAsPublished) {
  std::vector<Input> messages;
  for (const Time time : {0, 2, 1, 3, 3, 5, 4, 7, 8, 9}) {
    messages.push_back({static_cast<std::uint32_t>(messages.size()), time, time});
  }
  EXPECT_EQ(digest_of(messages), "813c4eb55e1195e5af9482f60d9b214cd083a8805720ec1663812637d716e4d5");
}

}  // namespace
}  // namespace flexcast::mcap::test
