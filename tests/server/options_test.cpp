#include "server/options.h"

#include <gtest/gtest.h>

#include "server/world_claim.h"

namespace flexcast::server {
namespace {

std::variant<Options, int> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "flexcast-server");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

TEST(ServerOptions, DefaultsAreDomain0RealtimeAndTheScenesName) {
  const auto options = std::get<Options>(parse({"rope.toml"}));
  EXPECT_EQ(options.scene, "rope.toml");
  EXPECT_EQ(options.world, "");
  EXPECT_EQ(options.domain, 0);
  EXPECT_EQ(options.rate, 1.0);
  EXPECT_EQ(options.checkpoints, "checkpoints");
  EXPECT_FALSE(options.paused);
  EXPECT_FALSE(options.until.has_value());
}

TEST(ServerOptions, EveryOptionIsUnderstood) {
  const auto options = std::get<Options>(
      parse({"rope.toml", "--world",   "w_1-a",    "--domain", "7",     "--profile", "lan",
             "--rate",    "2.5",       "--paused", "--until",  "1e1",   "--exit",    "--checkpoints",
             "/tmp/c",    "--threads", "2",        "--set",    "a.b=1", "--set",     "gravity=[0,0,-3]"}));
  EXPECT_EQ(options.world, "w_1-a");
  EXPECT_EQ(options.domain, 7);
  EXPECT_EQ(options.profile, "lan");
  EXPECT_EQ(options.rate, 2.5);
  EXPECT_TRUE(options.paused);
  EXPECT_EQ(options.until, 10.0);
  EXPECT_EQ(options.checkpoints, "/tmp/c");
  EXPECT_EQ(options.threads, 2);
  EXPECT_TRUE(options.exit);
  EXPECT_EQ(options.overrides, (std::vector<std::string>{"a.b=1", "gravity=[0,0,-3]"}));
}

TEST(ServerOptions, AnIdentityIsAFolder) {
  EXPECT_EQ(std::get<Options>(parse({"s"})).security, "");
  EXPECT_EQ(std::get<Options>(parse({"s", "--security", "keys/server"})).security, "keys/server");
}

TEST(ServerOptions, RateIsRealtimeMaxOrANumber) {
  EXPECT_EQ(std::get<Options>(parse({"s", "--rate", "max"})).rate, 0.0);
  EXPECT_EQ(std::get<Options>(parse({"s", "--rate", "realtime"})).rate, 1.0);
  EXPECT_EQ(std::get<Options>(parse({"s", "--rate", "0.25"})).rate, 0.25);
}

TEST(ServerOptions, LockstepMayNameHowManyRecordersTheWorldBeginsWith) {
  EXPECT_FALSE(std::get<Options>(parse({"s"})).lockstep.has_value());
  const auto plain = std::get<Options>(parse({"--lockstep", "s"}));
  EXPECT_EQ(plain.lockstep, 0);
  EXPECT_EQ(plain.scene, "s");
  EXPECT_EQ(std::get<Options>(parse({"s", "--lockstep=2"})).lockstep, 2);
}

TEST(ServerOptions, AScenePathAfterSetIsStillTheScene) {
  const auto options = std::get<Options>(parse({"--set", "a=1", "scene.toml"}));
  EXPECT_EQ(options.scene, "scene.toml");
  EXPECT_EQ(options.overrides, (std::vector<std::string>{"a=1"}));
}

TEST(ServerOptions, BadUsageEndsWith2) {
  const std::vector<std::vector<const char*>> bad = {
      {},
      {"s", "--unknown"},
      {"s", "--lockstep=-1"},
      {"s", "--lockstep=some"},
      {"s", "--lockstep=51"},
      {"s", "--rate", "0"},
      {"s", "--rate", "-1"},
      {"s", "--rate", "nan"},
      {"s", "--rate", "fast"},
      {"s", "--until", "-1"},
      {"s", "--until", "inf"},
      {"s", "--until", "soon"},
      {"s", "--exit"},
      {"s", "--domain", "-1"},
      {"s", "--domain", "231"},
      {"s", "--domain", "x"},
      {"s", "--world", ""},
      {"s", "--world", "a b"},
      {"s", "--world", "a/b"},
      {"s", "--set", "nothing"},
      {"s", "--set", "=1"},
      {"s", "t"},
  };
  for (const auto& arguments : bad) {
    const auto parsed = parse(arguments);
    const int* code = std::get_if<int>(&parsed);
    ASSERT_NE(code, nullptr) << (arguments.empty() ? "no arguments" : arguments.back());
    EXPECT_EQ(*code, 2);
  }
}

TEST(ServerOptions, HelpAndVersionEndWith0) {
  EXPECT_EQ(std::get<int>(parse({"--help"})), 0);
  EXPECT_EQ(std::get<int>(parse({"--version"})), 0);
}

TEST(WorldClaim, ARunningServerKeepsTheNameAndOfTwoNewOnesTheOlder) {
  EXPECT_TRUE(must_yield(100, {.server_id = 200, .heartbeat = 5}));
  EXPECT_TRUE(must_yield(200, {.server_id = 100, .heartbeat = 0}));
  EXPECT_FALSE(must_yield(100, {.server_id = 200, .heartbeat = 0}));
}

}  // namespace
}  // namespace flexcast::server
