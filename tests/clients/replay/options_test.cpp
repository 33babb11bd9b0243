#include "clients/replay/options.h"

#include <gtest/gtest.h>

#include <vector>

namespace flexcast::replay {
namespace {

std::variant<Options, int> parse(std::vector<const char*> words) {
  words.insert(words.begin(), "flexcast-replay");
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  auto parsed = parse_options(static_cast<int>(words.size()), words.data());
  testing::internal::GetCapturedStdout();
  testing::internal::GetCapturedStderr();
  return parsed;
}

TEST(ReplayOptions, ARecordingAloneIsPlayedInRealTimeToTheEndAndStays) {
  const auto options = std::get<Options>(parse({"run.mcap"}));
  EXPECT_EQ(options.file, "run.mcap");
  EXPECT_EQ(options.rate, 1.0);
  EXPECT_FALSE(options.from || options.to || options.loop || options.paused || options.exit);
}

TEST(ReplayOptions, EveryOptionIsTaken) {
  const auto options =
      std::get<Options>(parse({"run.mcap", "--rate", "max", "--from", "1", "--to", "2.5", "--loop", "--paused", "--as",
                               "again", "--domain", "7", "--profile", "lan", "--security", "keys"}));
  EXPECT_EQ(options.rate, 0.0);
  EXPECT_EQ(options.from, 1.0);
  EXPECT_EQ(options.to, 2.5);
  EXPECT_TRUE(options.loop && options.paused);
  EXPECT_EQ(options.world, "again");
  EXPECT_EQ(options.domain, 7);
  EXPECT_EQ(options.profile, "lan");
  EXPECT_EQ(options.security, "keys");
  EXPECT_EQ(std::get<Options>(parse({"run.mcap", "--rate", "0.25"})).rate, 0.25);
}

TEST(ReplayOptions, HelpAndVersionEndWellBadUsageDoesNot) {
  EXPECT_EQ(std::get<int>(parse({"--help"})), 0);
  EXPECT_EQ(std::get<int>(parse({"--version"})), 0);
  for (const auto& words : std::vector<std::vector<const char*>>{{},
                                                                 {"run.mcap", "--rate", "-1"},
                                                                 {"run.mcap", "--rate", "0"},
                                                                 {"run.mcap", "--rate", "fast"},
                                                                 {"run.mcap", "--from", "-1"},
                                                                 {"run.mcap", "--from", "2", "--to", "1"},
                                                                 {"run.mcap", "--as", "a world"},
                                                                 {"run.mcap", "--domain", "231"},
                                                                 {"run.mcap", "--loop", "--exit"},
                                                                 {"run.mcap", "--fly"}}) {
    const auto parsed = parse(words);
    ASSERT_TRUE(std::holds_alternative<int>(parsed)) << words.back();
    EXPECT_EQ(std::get<int>(parsed), 2) << words.back();
  }
}

}  // namespace
}  // namespace flexcast::replay
