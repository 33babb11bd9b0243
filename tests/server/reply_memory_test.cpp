#include "server/reply_memory.h"

#include <gtest/gtest.h>

namespace flexcast::server {
namespace {

using Seen = ReplyMemory::Seen;

Reply make_reply(const RequestKey& key, std::int64_t applied_step = 0) {
  Reply reply;
  reply.key = key;
  reply.applied_step = applied_step;
  return reply;
}

TEST(ReplyMemory, ARepeatedRequestIsExecutedOnceAndAnsweredFromMemory) {
  ReplyMemory memory;
  const RequestKey key{"a", 7};
  int executed = 0;
  for (int i = 0; i < 3; ++i) {
    const auto lookup = memory.begin(key);
    if (lookup.seen == Seen::first) {
      ++executed;
      memory.store(make_reply(key, 120));
    } else {
      ASSERT_EQ(lookup.seen, Seen::answered);
      EXPECT_EQ(lookup.reply->applied_step, 120);
    }
  }
  EXPECT_EQ(executed, 1);
}

TEST(ReplyMemory, ARequestInFlightIsNotExecutedTwice) {
  ReplyMemory memory;
  EXPECT_EQ(memory.begin({"a", 1}).seen, Seen::first);
  EXPECT_EQ(memory.begin({"a", 1}).seen, Seen::in_flight);
  memory.store(make_reply({"a", 1}));
  EXPECT_EQ(memory.begin({"a", 1}).seen, Seen::answered);
}

TEST(ReplyMemory, ClientsDoNotShareRequestIds) {
  ReplyMemory memory;
  memory.begin({"a", 1});
  memory.store(make_reply({"a", 1}));
  EXPECT_EQ(memory.begin({"b", 1}).seen, Seen::first);
}

TEST(ReplyMemory, RemembersTheLast256RepliesOfEachClient) {
  ReplyMemory memory;
  for (std::uint64_t i = 0; i < 300; ++i) {
    memory.begin({"a", i});
    memory.store(make_reply({"a", i}));
  }
  EXPECT_EQ(memory.begin({"a", 299}).seen, Seen::answered);
  EXPECT_EQ(memory.begin({"a", 300 - 256}).seen, Seen::answered);
  EXPECT_EQ(memory.begin({"a", 300 - 257}).seen, Seen::first);
}

TEST(ReplyMemory, AForgottenRequestCountsAsNew) {
  ReplyMemory memory;
  memory.begin({"a", 1});
  memory.forget({"a", 1});
  EXPECT_EQ(memory.begin({"a", 1}).seen, Seen::first);
}

TEST(ReplyMemory, OfTooManyClientsTheLongestSilentIsForgottenButNoRequestInFlight) {
  ReplyMemory memory({.replies = 4, .clients = 3});
  memory.begin({"in flight", 1});
  for (const char* client : {"a", "b", "c"}) {
    memory.begin({client, 1});
    memory.store(make_reply({client, 1}));
  }
  EXPECT_EQ(memory.begin({"in flight", 1}).seen, Seen::in_flight);
  EXPECT_EQ(memory.begin({"c", 1}).seen, Seen::answered);
  EXPECT_EQ(memory.begin({"b", 1}).seen, Seen::answered);
  EXPECT_EQ(memory.begin({"a", 1}).seen, Seen::first);
}

}  // namespace
}  // namespace flexcast::server
