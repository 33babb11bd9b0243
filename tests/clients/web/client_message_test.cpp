#include "clients/web/client_message.h"

#include <gtest/gtest.h>

namespace flexcast::web {
namespace {

template <class T>
T parse_as(const std::string& text) {
  const auto message = parse_message(true, text);
  EXPECT_TRUE(message.ok()) << text;
  return std::get<T>(message.value());
}

std::string error_of(bool is_text, const std::string& message) {
  const auto parsed = parse_message(is_text, message);
  return parsed ? "" : parsed.error().message;
}

TEST(ClientMessage, TheOperationsOfTheProtocolAreUnderstood) {
  const auto subscribe = parse_as<Subscribe>(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":7}]})");
  ASSERT_EQ(subscribe.entries.size(), 1u);
  EXPECT_EQ(subscribe.entries[0].channel, 7u);
  EXPECT_EQ(parse_as<Unsubscribe>(R"({"op":"unsubscribe","subscriptionIds":[3]})").ids, std::vector{3u});
  const auto get = parse_as<GetParameters>(R"({"op":"getParameters","parameterNames":["a"],"id":"x"})");
  EXPECT_EQ(get.names, std::vector<std::string>{"a"});
  EXPECT_EQ(get.id, "x");
  const auto set = parse_as<SetParameters>(
      R"({"op":"setParameters","parameters":[{"name":"g","value":[0,0,1],"type":"float64_array"},{"name":"h"}]})");
  EXPECT_EQ(set.entries[0].value, Json::parse("[0,0,1]"));
  EXPECT_TRUE(set.entries[1].value.is_null());
  EXPECT_FALSE(set.id);
  EXPECT_TRUE(parse_as<WatchParameters>(R"({"op":"subscribeParameterUpdates","parameterNames":[]})").on);
  EXPECT_FALSE(parse_as<WatchParameters>(R"({"op":"unsubscribeParameterUpdates","parameterNames":[]})").on);
}

TEST(ClientMessage, AServiceCallIsTakenApart) {
  const std::string call("\x02\x05\0\0\0\x09\0\0\0\x04\0\0\0json{}", 19);
  const auto parsed = parse_message(false, call);
  ASSERT_TRUE(parsed.ok());
  const auto& message = std::get<CallService>(parsed.value());
  EXPECT_EQ(message.service, 5u);
  EXPECT_EQ(message.call, 9u);
  EXPECT_EQ(message.encoding, "json");
  EXPECT_EQ(message.payload, "{}");
  for (std::size_t size = 0; size < 17; ++size) EXPECT_NE(error_of(false, call.substr(0, size)), "") << size;
}

TEST(ClientMessage, WhatIsWrongIsSaidPlainly) {
  EXPECT_EQ(error_of(true, "nonsense"), "this is no JSON");
  EXPECT_EQ(error_of(true, "[1]"), "a message must be a JSON object with a string 'op'");
  EXPECT_EQ(error_of(true, R"({"op":"fetchAsset"})"), "'fetchAsset' is not among the capabilities of this server");
  EXPECT_EQ(error_of(true, R"({"op":"unsubscribe","subscriptionIds":[-1]})"),
            "'subscriptionIds' must be an array of numbers");
  EXPECT_EQ(error_of(true, R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})"),
            "'subscriptions' must be an array of objects with the numbers 'id' and 'channelId'");
  EXPECT_EQ(error_of(true, R"({"op":"getParameters","parameterNames":[],"id":5})"), "'id' must be a string");
  EXPECT_EQ(error_of(false, "\x01"), "binary messages must be service calls (opcode 2)");
}

TEST(ClientMessage, DeepJsonIsRefusedBeforeItIsBuilt) {
  EXPECT_EQ(error_of(true, std::string(60000, '[')), "JSON that is nested too deep");
  EXPECT_EQ(error_of(true, R"({"op":)" + std::string(60000, '[')), "JSON that is nested too deep");
}

}  // namespace
}  // namespace flexcast::web
