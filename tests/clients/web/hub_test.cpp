#include "clients/web/hub.h"

#include <gtest/gtest.h>

#include "tests/clients/web/web.h"

namespace flexcast::web {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

class HubTest : public testing::Test {
 protected:
  explicit HubTest(const std::string& home = "")
      : hub_(
            {.world = home, .place = "domain 7 (profile loopback)", .session = "s"}, port_,
            [this](const Wanted& wanted) { wanted_ = wanted; }, [this] { return now_; }) {}

  void say_status(const std::string& world, std::uint64_t server = 1) {
    hub_.take({{StatusNews{world, server, {}, make_sample("status of " + world, 99)}}, {}});
  }
  void end(const std::string& world) { hub_.take({{EndNews{world, true}}, {}}); }
  void say_parameters(const std::string& world, double stiffness) {
    ParameterTable table;
    table.values = {{"rope.stiffness", stiffness}, {"gravity", client::Vector{0, 0, -1}}};
    table.descriptors.emplace_back();
    table.descriptors.back().name = "rope.stiffness";
    hub_.take({{StateNews{.world = world,
                          .topic = wire::TopicId::parameters,
                          .sample = make_sample("parameters"),
                          .parameters = std::make_shared<const ParameterTable>(table)}},
               {}});
  }
  void reply(const client::Reply& reply) {
    hub_.take({{ReplyNews{port_.sent.back().world, port_.sent.back().request_id, reply}}, {}});
  }
  void pass(std::chrono::milliseconds time) {
    for (; time > 0ms; time -= 100ms) {
      now_ += 100ms;
      hub_.tick();
    }
  }
  void connect() { client_ = hub_.connect(line_); }
  void say(const Json& json) { client_->receive(true, json.dump()); }
  void call(std::uint32_t service, const std::string& json) {
    std::string message("\x02\0\0\0\0\x07\0\0\0\x04\0\0\0json", 17);
    message[1] = static_cast<char>(service);
    client_->receive(false, message + json);
  }
  std::vector<Outgoing> hear() { return drain(*client_); }
  // The number of a channel or service that was advertised.
  static std::uint32_t id_of(const std::vector<Outgoing>& messages, const std::string& op, const std::string& list,
                             const std::string& key, const std::string& name) {
    for (const Json& message : with_op(messages, op))
      for (const Json& entry : message[list])
        if (entry[key] == name) return entry["id"];
    return 0;
  }
  static std::uint32_t channel_id(const std::vector<Outgoing>& messages, const std::string& topic) {
    return id_of(messages, "advertise", "channels", "topic", topic);
  }
  static std::uint32_t service_id(const std::vector<Outgoing>& messages, const std::string& name) {
    return id_of(messages, "advertiseServices", "services", "name", name);
  }
  static Json last_status(const std::vector<Outgoing>& messages) {
    const auto all = with_op(messages, "status");
    return all.empty() ? Json() : all.back();
  }

  FakePort port_;
  Wanted wanted_;
  Hub::Clock::time_point now_{1000s};
  FakeLine line_;
  Hub hub_;
  std::unique_ptr<Peer> client_;
};

TEST_F(HubTest, AClientIsGreetedWithWhatTheServerIs) {
  connect();
  const auto heard = hear();
  const Json info = with_op(heard, "serverInfo").at(0);
  EXPECT_EQ(info["name"], "flexcast-web");
  EXPECT_EQ(info["capabilities"], Json::parse(R"(["parameters","parametersSubscribe","services","time"])"));
  EXPECT_EQ(info["metadata"]["world"], "");
  EXPECT_EQ(last_status(heard)["id"], "no-world");
  EXPECT_EQ(last_status(heard)["message"], "looking for a world on domain 7 (profile loopback)");
  EXPECT_EQ(with_op(heard, "advertise").size(), 1u);
}

TEST_F(HubTest, TheFirstWorldIsTheHomeAndOthersHavePrefixes) {
  say_status("rope");
  say_status("beam");
  connect();
  const auto heard = hear();
  EXPECT_EQ(with_op(heard, "serverInfo").at(0)["metadata"]["world"], "rope");
  EXPECT_TRUE(with_op(heard, "status").empty());
  for (const char* topic : {"scene", "topology", "parameters", "frames", "status", "events", "points"}) {
    EXPECT_NE(channel_id(heard, std::string("flexcast/") + topic), 0u) << topic;
    EXPECT_NE(channel_id(heard, std::string("beam/flexcast/") + topic), 0u) << topic;
  }
  EXPECT_EQ(channel_id(heard, "flexcast/commands"), 0u);
  EXPECT_NE(service_id(heard, "flexcast/run_until"), 0u);
  EXPECT_NE(service_id(heard, "beam/flexcast/run_until"), 0u);
}

class NamedHubTest : public HubTest {
 protected:
  NamedHubTest() : HubTest("beam") {}
};

TEST_F(NamedHubTest, ANamedWorldIsTheHomeWheneverItComes) {
  say_status("rope");
  connect();
  EXPECT_EQ(last_status(hear())["message"], "looking for world 'beam' on domain 7 (profile loopback)");
  say_status("beam");
  const auto heard = hear();
  EXPECT_NE(channel_id(heard, "flexcast/frames"), 0u);
  EXPECT_EQ(with_op(heard, "removeStatus").at(0)["statusIds"], Json::array({"no-world"}));
}

TEST_F(HubTest, AWorldThatFallsSilentIsSaidOnceAndItsReturnToo) {
  say_status("rope");
  connect();
  hear();
  pass(1700ms);
  EXPECT_TRUE(with_op(hear(), "status").empty());
  pass(2000ms);
  const auto heard = with_op(hear(), "status");
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0]["id"], "world:rope");
  EXPECT_EQ(heard[0]["level"], 2);
  say_status("rope", 2);  // another process
  const auto back = hear();
  EXPECT_EQ(with_op(back, "removeStatus").at(0)["statusIds"], Json::array({"world:rope"}));
  EXPECT_TRUE(with_op(back, "advertise").empty());  // the channels have gone on
}

TEST_F(HubTest, AWorldThatEndsLosesItsChannelsAndGetsTheSameOnesBack) {
  say_status("rope");
  connect();
  const auto first = hear();
  say({{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", channel_id(first, "flexcast/status")}}}}});
  hear();
  end("rope");
  const auto ended = hear();
  EXPECT_EQ(with_op(ended, "unadvertise").at(0)["channelIds"].size(), 7u);
  EXPECT_EQ(with_op(ended, "unadvertiseServices").at(0)["serviceIds"].size(), 13u);
  const auto statuses = with_op(ended, "status");
  EXPECT_TRUE(std::any_of(statuses.begin(), statuses.end(),
                          [](const Json& s) { return s["id"] == "world:rope" && s["level"] == 1; }));
  say_status("rope");
  const auto again = hear();
  EXPECT_EQ(channel_id(again, "flexcast/status"), channel_id(first, "flexcast/status"));
  EXPECT_TRUE(payloads(again).empty());  // the subscription went with the channel
}

TEST_F(HubTest, WhenTheHomeHasEndedTheNextWorldTakesItsPlace) {
  say_status("rope");
  connect();
  end("rope");
  hear();
  say_status("beam");
  const auto heard = hear();
  EXPECT_EQ(with_op(heard, "serverInfo").at(0)["metadata"]["world"], "beam");
  EXPECT_NE(channel_id(heard, "flexcast/frames"), 0u);
}

TEST_F(HubTest, FramesAreWantedWhileSomebodySubscribesAndAWhileLonger) {
  say_status("rope");
  connect();
  const auto channel = channel_id(hear(), "flexcast/frames");
  EXPECT_FALSE(wanted_.frames);
  say({{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", channel}}}}});
  EXPECT_TRUE(wanted_.frames);
  EXPECT_TRUE(wanted_.points.empty());
  hub_.take(Delivery{{}, {{"rope", make_frame(5)}}});
  EXPECT_EQ(payloads(hear()), std::vector<std::string>{"5.0"});
  client_.reset();
  pass(1s);
  EXPECT_TRUE(wanted_.frames);
  pass(1500ms);
  EXPECT_FALSE(wanted_.frames);
}

TEST_F(HubTest, ParametersAreReadWithTheirTypes) {
  say_status("rope");
  say_parameters("rope", 20);
  connect();
  hear();
  say({{"op", "getParameters"}, {"parameterNames", Json::array()}, {"id", "a"}});
  const Json values = with_op(hear(), "parameterValues").at(0);
  EXPECT_EQ(values["id"], "a");
  EXPECT_EQ(values["parameters"][0], Json::parse(R"({"name":"rope.stiffness","value":20.0,"type":"float64"})"));
  EXPECT_EQ(values["parameters"][1],
            Json::parse(R"({"name":"gravity","value":[0.0,0.0,-1.0],"type":"float64_array"})"));
}

TEST_F(HubTest, OfChangedParametersThoseWhoAskedHear) {
  say_status("rope");
  say_parameters("rope", 20);
  connect();
  say({{"op", "subscribeParameterUpdates"}, {"parameterNames", {"rope.stiffness"}}});
  hear();
  say_parameters("rope", 20);
  EXPECT_TRUE(with_op(hear(), "parameterValues").empty());
  say_parameters("rope", 21);
  const Json values = with_op(hear(), "parameterValues").at(0);
  EXPECT_EQ(values["parameters"].size(), 1u);
  EXPECT_EQ(values["parameters"][0]["value"], 21.0);
  say({{"op", "unsubscribeParameterUpdates"}, {"parameterNames", Json::array()}});
  say_parameters("rope", 22);
  EXPECT_TRUE(with_op(hear(), "parameterValues").empty());
}

TEST_F(HubTest, ASetIsACommandAndItsAnswerTheValuesInForce) {
  say_status("rope");
  say_parameters("rope", 20);
  connect();
  hear();
  say({{"op", "setParameters"}, {"parameters", {{{"name", "rope.stiffness"}, {"value", 25}}}}, {"id", "b"}});
  ASSERT_EQ(port_.sent.size(), 1u);
  EXPECT_EQ(port_.sent[0].kind, flexcast_COMMAND_SET);
  EXPECT_EQ(port_.sent[0].values[0], (client::Parameter{"rope.stiffness", 25.0}));
  reply({.outcome = flexcast_OUTCOME_APPLIED, .values = {{"rope.stiffness", 25.0}}});
  const Json values = with_op(hear(), "parameterValues").at(0);
  EXPECT_EQ(values["id"], "b");
  EXPECT_EQ(values["parameters"][0]["value"], 25.0);
}

TEST_F(HubTest, ARefusedSetSaysWhyAndWhatIsInForce) {
  say_status("rope");
  say_parameters("rope", 20);
  connect();
  hear();
  say({{"op", "setParameters"}, {"parameters", {{{"name", "rope.stiffness"}, {"value", -1}}}}, {"id", "b"}});
  reply({.outcome = flexcast_OUTCOME_REJECTED, .reason = "rope.stiffness = -1 is not allowed"});
  const auto heard = hear();
  EXPECT_EQ(last_status(heard)["level"], 2);
  EXPECT_EQ(last_status(heard)["message"], "rope.stiffness = -1 is not allowed");
  EXPECT_EQ(with_op(heard, "parameterValues").at(0)["parameters"][0]["value"], 20.0);
  EXPECT_EQ(with_op(heard, "parameterValues").at(0)["id"], "b");
}

TEST_F(HubTest, ParametersOfOtherWorldsHaveTheirPrefix) {
  say_status("rope");
  say_status("beam");
  say_parameters("beam", 3);
  connect();
  hear();
  say({{"op", "setParameters"}, {"parameters", {{{"name", "beam/rope.stiffness"}, {"value", 4}}}}});
  ASSERT_EQ(port_.sent.size(), 1u);
  EXPECT_EQ(port_.sent[0].world, "beam");
  EXPECT_EQ(port_.sent[0].values[0].name, "rope.stiffness");
  say({{"op", "setParameters"}, {"parameters", {{{"name", "other/x"}, {"value", 4}}}}});
  EXPECT_EQ(last_status(hear())["message"], "there is no world for the parameter 'other/x'");
}

TEST_F(HubTest, AServiceAnswersWithWhatTheServerSaid) {
  say_status("rope");
  connect();
  const auto id = service_id(hear(), "flexcast/step");
  call(id, R"({"count":3})");
  ASSERT_EQ(port_.sent.size(), 1u);
  EXPECT_EQ(port_.sent[0].count, 3u);
  reply({.kind = flexcast_COMMAND_STEP, .outcome = flexcast_OUTCOME_WRONG_STATE, .reason = "no"});
  const auto heard = hear();
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0].head.substr(0, 17),
            (std::string("\x03") + static_cast<char>(id) + std::string("\0\0\0\x07\0\0\0\x04\0\0\0json", 15)));
  EXPECT_EQ(Json::parse(heard[0].head.substr(17))["outcome"], "wrong_state");
}

TEST_F(HubTest, ACallThatCannotBeMadeFailsWithASentence) {
  say_status("rope");
  connect();
  const auto id = service_id(hear(), "flexcast/step");
  call(200, "{}");
  EXPECT_EQ(with_op(hear(), "serviceCallFailure").at(0)["message"], "there is no service 200");
  call(id, "nonsense");
  EXPECT_EQ(with_op(hear(), "serviceCallFailure").at(0)["message"], "step: this is no JSON");
  call(id, "{}");
  say_status("rope", 2);
  EXPECT_EQ(with_op(hear(), "serviceCallFailure").at(0)["message"], "the server of world 'rope' was restarted");
  call(id, "{}");
  end("rope");
  EXPECT_EQ(with_op(hear(), "serviceCallFailure").at(0)["message"], "world 'rope' has ended");
}

TEST_F(HubTest, WhoMayOnlyWatchOffersNoCommands) {
  port_.allowed = false;
  say_status("rope");
  say_parameters("rope", 20);
  connect();
  const auto heard = hear();
  EXPECT_TRUE(with_op(heard, "advertiseServices").empty());
  call(1, "{}");
  EXPECT_EQ(with_op(hear(), "serviceCallFailure").size(), 1u);
  say({{"op", "setParameters"}, {"parameters", {{{"name", "rope.stiffness"}, {"value", 1}}}}});
  EXPECT_EQ(last_status(hear())["message"], "the identity of this flexcast-web may only watch");
  EXPECT_TRUE(port_.sent.empty());
}

TEST_F(HubTest, TimeGoesToEverybodyAtMostTenTimesASecond) {
  connect();
  hear();
  for (int i = 0; i < 30; ++i) {
    say_status("rope");
    now_ += 10ms;
  }
  const auto heard = hear();
  EXPECT_EQ(std::count_if(heard.begin(), heard.end(),
                          [](const Outgoing& message) { return !message.is_text && message.head[0] == 2; }),
            3);
}

TEST_F(HubTest, ASubscriptionToNothingIsSaid) {
  connect();
  hear();
  say({{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", 77}}}}});
  EXPECT_EQ(last_status(hear())["message"], "there is no channel 77");
  say({{"op", "unsubscribe"}, {"subscriptionIds", {1}}});
  EXPECT_EQ(last_status(hear())["message"], "there is no subscription 1");
}

TEST_F(HubTest, ThereAreAtMostThirtyTwoClients) {
  std::vector<std::unique_ptr<Peer>> clients;
  for (std::size_t i = 0; i < Hub::most_clients; ++i) clients.push_back(hub_.connect(line_));
  EXPECT_TRUE(hub_.is_full());
  EXPECT_EQ(hub_.connect(line_), nullptr);
  clients.pop_back();
  EXPECT_FALSE(hub_.is_full());
}

TEST(WorldRecord, TopologiesOfAnEarlierRunGoAndEventsToo) {
  WorldRecord world("beam");
  const auto topology = [](std::uint64_t run, std::uint64_t key) {
    return StateNews{
        .world = "beam", .topic = wire::TopicId::topology, .key = key, .run_id = run, .sample = make_sample("t")};
  };
  for (const std::uint64_t key : {0, 1, 2}) world.add_state(topology(1, key));
  world.add_state(topology(2, 0));
  EXPECT_EQ(world.state_keys(wire::TopicId::topology), std::vector<std::uint64_t>{0});
  for (std::size_t i = 0; i < 300; ++i) world.add_event({.world = "beam", .run_id = 1, .sample = make_sample("e")});
  EXPECT_EQ(world.events().size(), WorldRecord::most_events);
  world.add_event({.world = "beam", .run_id = 2, .sample = make_sample("e")});
  EXPECT_EQ(world.events().size(), 1u);
}

}  // namespace
}  // namespace flexcast::web
