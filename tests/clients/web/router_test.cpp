#include "clients/web/router.h"

#include <gtest/gtest.h>

#include "tests/clients/web/web.h"

namespace flexcast::web {
namespace {

using namespace std::chrono_literals;

class RouterTest : public testing::Test {
 protected:
  void send(flexcast_CommandKind kind, const void* owner = nullptr) {
    router_.send("beam", {.kind = kind}, owner, now_, [this](const wire::Result<client::Reply>& reply) {
      answers_.push_back(reply ? "ok" : reply.error().message);
    });
  }
  void pass(std::chrono::milliseconds time) {
    for (; time > 0ms; time -= 100ms) {
      now_ += 100ms;
      router_.tick(now_);
    }
  }

  FakePort port_;
  Router::Clock::time_point now_{1000s};
  Router router_{port_, [](const std::string&) { return wire::Guid{}; }};
  std::vector<std::string> answers_;
};

TEST_F(RouterTest, ACommandIsSentAgainWithItsNumberUntilItIsAnsweredOnce) {
  send(flexcast_COMMAND_PAUSE);
  pass(2500ms);
  ASSERT_EQ(port_.sent.size(), 3u);
  EXPECT_EQ(port_.sent[2].request_id, port_.sent[0].request_id);
  EXPECT_EQ(port_.sent[0].expires_in, 10.0);
  router_.receive("beam", port_.sent[0].request_id, {});
  router_.receive("beam", port_.sent[0].request_id, {});
  pass(12s);
  EXPECT_EQ(port_.sent.size(), 3u);
  EXPECT_EQ(answers_, std::vector<std::string>{"ok"});
}

TEST_F(RouterTest, AReplyOfAnotherWorldIsNone) {
  send(flexcast_COMMAND_PAUSE);
  router_.receive("rope", port_.sent[0].request_id, {});
  EXPECT_TRUE(answers_.empty());
}

TEST_F(RouterTest, WithoutAnAnswerItIsGivenUpAfterTenSeconds) {
  send(flexcast_COMMAND_PAUSE);
  pass(9900ms);
  EXPECT_TRUE(answers_.empty());
  pass(200ms);
  EXPECT_EQ(answers_, std::vector<std::string>{"no answer from world 'beam' to pause within 10 s"});
}

TEST_F(RouterTest, AServerThatCannotBeReachedYetGetsItAsSoonAsItCan) {
  port_.reachable = false;
  send(flexcast_COMMAND_PAUSE);
  pass(300ms);
  EXPECT_TRUE(port_.sent.empty());
  port_.reachable = true;
  pass(100ms);
  EXPECT_EQ(port_.sent.size(), 1u);
}

TEST_F(RouterTest, StepsTakeTheirTimeAsLongAsTheWorldLives) {
  send(flexcast_COMMAND_STEP);
  EXPECT_EQ(port_.sent[0].expires_in, 0.0);
  for (int i = 0; i < 60; ++i) {
    pass(1s);
    router_.note_life("beam", now_);
  }
  EXPECT_TRUE(answers_.empty());
  pass(10100ms);
  EXPECT_EQ(answers_.size(), 1u);
}

TEST_F(RouterTest, WhatIsUnderWayToALostWorldIsAnsweredAtOnce) {
  send(flexcast_COMMAND_STEP);
  router_.lose("rope", "gone");
  EXPECT_TRUE(answers_.empty());
  router_.lose("beam", "gone");
  EXPECT_EQ(answers_, std::vector<std::string>{"gone"});
}

TEST_F(RouterTest, AnOwnerThatHasGoneHearsNothing) {
  int owner = 0;
  send(flexcast_COMMAND_PAUSE, &owner);
  router_.forget(&owner);
  router_.receive("beam", port_.sent[0].request_id, {});
  EXPECT_TRUE(answers_.empty());
}

TEST_F(RouterTest, AnOwnerMayHaveSoManyUnderWay) {
  for (std::size_t i = 0; i < Router::most_of_an_owner; ++i) send(flexcast_COMMAND_PAUSE);
  EXPECT_TRUE(answers_.empty());
  send(flexcast_COMMAND_PAUSE);
  EXPECT_EQ(answers_, std::vector<std::string>{"there are 64 calls under way already"});
}

}  // namespace
}  // namespace flexcast::web
