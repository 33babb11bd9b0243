#include "clients/replay/reply_memory.h"

#include <gtest/gtest.h>

#include "idl/wire/fill.h"

namespace flexcast::replay {
namespace {

using Seen = ReplyMemory::Seen;

wire::Owned<flexcast_Reply> make_reply(const std::string& client, std::uint64_t request, const std::string& reason) {
  wire::Owned<flexcast_Reply> reply;
  wire::set_string(reply->client_id, client);
  reply->request_id = request;
  wire::set_string(reply->reason, reason);
  return reply;
}

TEST(ReplayReplyMemory, ARequestIsFirstThenInFlightThenAnsweredFromMemory) {
  ReplyMemory memory;
  EXPECT_EQ(memory.begin("a", 1).seen, Seen::first);
  EXPECT_EQ(memory.begin("a", 1).seen, Seen::in_flight);
  EXPECT_EQ(memory.begin("b", 1).seen, Seen::first);
  memory.store(make_reply("a", 1, "because"));
  const auto lookup = memory.begin("a", 1);
  ASSERT_EQ(lookup.seen, Seen::answered);
  EXPECT_EQ(wire::text(lookup.reply->reason), "because");
  EXPECT_EQ(memory.begin("b", 1).seen, Seen::in_flight);
}

TEST(ReplayReplyMemory, HoldsSoManyRepliesOfAClientAndSoManyClients) {
  ReplyMemory memory;
  for (std::uint64_t request = 0; request <= ReplyMemory::most_replies; ++request) {
    memory.begin("a", request);
    memory.store(make_reply("a", request, ""));
  }
  EXPECT_EQ(memory.begin("a", 1).seen, Seen::answered);
  EXPECT_EQ(memory.begin("a", 0).seen, Seen::first);  // forgotten
  memory.store(make_reply("a", 0, ""));
  memory.begin("patient", 1);  // in flight: stays
  for (std::size_t i = 0; i < ReplyMemory::most_clients; ++i) {
    const std::string client = "c" + std::to_string(i);
    memory.begin(client, 1);
    memory.store(make_reply(client, 1, ""));
  }
  EXPECT_EQ(memory.begin("patient", 1).seen, Seen::in_flight);
  EXPECT_EQ(memory.begin("a", 2).seen, Seen::first);
}

}  // namespace
}  // namespace flexcast::replay
