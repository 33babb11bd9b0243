#include "clients/web/client.h"

#include <gtest/gtest.h>

#include "tests/clients/web/web.h"

namespace flexcast::web {
namespace {

class NoHost final : public ClientHost {
 public:
  void handle(Client&, bool, std::string_view) override { ++handled; }
  void forget(Client&) override {}
  int handled = 0;
};

class ClientTest : public testing::Test {
 protected:
  const Channel& channel(std::string_view topic) {
    for (const Channel* entry : catalog_.channels("beam", ""))
      if (entry->topic == topic) return *entry;
    throw std::runtime_error("no such channel");
  }
  void subscribe(std::uint32_t id, std::string_view topic) {
    EXPECT_EQ(client_.subscribe(id, channel(topic), world_), "");
  }
  void add_state(wire::TopicId topic, std::uint64_t key, const std::string& text) {
    world_.add_state({.world = "beam", .topic = topic, .key = key, .sample = make_sample(text)});
    client_.note_state(world_, topic, key);
  }
  void add_frame(std::uint64_t number, std::size_t chunks = 1) {
    world_.add_frame(make_frame(number, chunks));
    client_.note_frame(world_);
  }
  std::vector<std::string> sent() { return payloads(drain(client_)); }

  using Texts = std::vector<std::string>;
  Catalog catalog_;
  WorldRecord world_{"beam"};
  NoHost host_;
  FakeLine line_;
  Client client_{line_, host_};
};

TEST_F(ClientTest, ANewSubscriberGetsWhatThereIsSceneAndTopologyBeforeFrames) {
  add_state(wire::TopicId::parameters, 0, "parameters");
  add_state(wire::TopicId::topology, 1, "topology 1");
  add_state(wire::TopicId::topology, 0, "topology 0");
  add_state(wire::TopicId::scene, 0, "scene");
  world_.add_status(make_sample("status"));
  world_.add_event({.world = "beam", .run_id = 1, .sample = make_sample("event")});
  add_frame(7);
  std::uint32_t id = 0;
  for (const char* topic : {"flexcast/frames", "flexcast/topology", "flexcast/events", "flexcast/parameters",
                            "flexcast/status", "flexcast/scene"})
    subscribe(id++, topic);
  EXPECT_EQ(sent(), (Texts{"event", "status", "scene", "topology 0", "topology 1", "parameters", "7.0"}));
}

TEST_F(ClientTest, ASlowClientGetsTheNewestFrameAndEverySmallMessage) {
  subscribe(1, "flexcast/frames");
  subscribe(2, "flexcast/status");
  for (std::uint64_t i = 0; i < 50; ++i) {
    add_frame(i);
    client_.note_log(world_, wire::TopicId::status, make_sample("status " + std::to_string(i)));
  }
  const auto texts = sent();
  ASSERT_EQ(texts.size(), 51u);
  EXPECT_EQ(texts[49], "status 49");
  EXPECT_EQ(texts[50], "49.0");
  EXPECT_TRUE(sent().empty());
  EXPECT_FALSE(line_.closed);
}

TEST_F(ClientTest, TheChunksOfAFrameStayTogetherWhateverComesMeanwhile) {
  subscribe(1, "flexcast/frames");
  subscribe(2, "flexcast/status");
  add_frame(0, 3);
  Texts texts = payloads({*client_.next()});
  add_frame(1, 3);
  client_.note_log(world_, wire::TopicId::status, make_sample("status"));
  for (const auto& text : sent()) texts.push_back(text);
  EXPECT_EQ(texts, (Texts{"0.0", "0.1", "0.2", "status", "1.0", "1.1", "1.2"}));
}

TEST_F(ClientTest, AFrameBegunIsNotGoneOnWithWhenItsSubscriptionEnds) {
  subscribe(1, "flexcast/frames");
  add_frame(0, 3);
  ASSERT_TRUE(client_.next());
  EXPECT_TRUE(client_.unsubscribe(1));
  EXPECT_FALSE(client_.unsubscribe(1));
  EXPECT_TRUE(sent().empty());
}

TEST_F(ClientTest, OfAStateThatChangesOftenTheNewestIsSent) {
  subscribe(1, "flexcast/parameters");
  for (int i = 0; i < 5; ++i) add_state(wire::TopicId::parameters, 0, std::to_string(i));
  EXPECT_EQ(sent(), Texts{"4"});
}

TEST_F(ClientTest, AMessageCarriesItsSubscriptionAndTime) {
  subscribe(0x01020304, "flexcast/status");
  client_.note_log(world_, wire::TopicId::status, make_sample("x", 0x1122334455667788));
  const auto message = client_.next();
  EXPECT_EQ(message->head, std::string("\x01\x04\x03\x02\x01\x88\x77\x66\x55\x44\x33\x22\x11", 13));
}

TEST_F(ClientTest, AChannelIsSubscribedOnceAndAnIdUsedOnce) {
  subscribe(1, "flexcast/frames");
  EXPECT_EQ(client_.subscribe(2, channel("flexcast/frames"), world_),
            "there is a subscription to flexcast/frames already");
  EXPECT_EQ(client_.subscribe(1, channel("flexcast/scene"), world_), "there is a subscription 1 already");
}

TEST_F(ClientTest, WhoTakesNoSmallMessagesIsClosed) {
  for (std::size_t i = 0; i < limits::queue_messages; ++i) client_.send({.head = "x"});
  EXPECT_FALSE(line_.closed);
  client_.send({.head = "x"});
  EXPECT_EQ(line_.closed, CloseCode::policy);
}

TEST_F(ClientTest, AMebibyteOfMessagesIsTheMost) {
  for (int i = 0; i < 4; ++i) client_.send({.head = std::string(limits::queue_bytes / 4, 'x')});
  EXPECT_FALSE(line_.closed);
  client_.send({.head = "x"});
  EXPECT_EQ(line_.closed, CloseCode::policy);
}

TEST_F(ClientTest, MessagesThatWereSentNoLongerCount) {
  for (int i = 0; i < 20; ++i) {
    client_.send({.head = std::string(limits::queue_bytes / 2, 'x')});
    ASSERT_TRUE(client_.next());
  }
  EXPECT_FALSE(line_.closed);
}

TEST_F(ClientTest, AFloodIsClosed) {
  for (int i = 0; i < 390; ++i) client_.receive(true, "{}");
  EXPECT_FALSE(line_.closed);
  EXPECT_EQ(host_.handled, 390);
  for (int i = 0; i < 2000; ++i) client_.receive(true, "{}");
  EXPECT_EQ(line_.closed, CloseCode::policy);
  EXPECT_LT(host_.handled, 1000);
}

TEST_F(ClientTest, PingsCountAsMessages) {
  for (int i = 0; i < 3000; ++i) client_.receive_control();
  EXPECT_EQ(line_.closed, CloseCode::policy);
}

TEST(RateLimit, GrantsABurstAndThenSoManyASecond) {
  RateLimit limit(10, 20);
  RateLimit::Clock::time_point now{std::chrono::seconds(5)};
  int passed = 0;
  for (int i = 0; i < 100; ++i) passed += limit.pass(now) ? 1 : 0;
  EXPECT_EQ(passed, 20);
  now += std::chrono::seconds(1);
  for (int i = 0; i < 100; ++i) passed += limit.pass(now) ? 1 : 0;
  EXPECT_EQ(passed, 30);
}

}  // namespace
}  // namespace flexcast::web
