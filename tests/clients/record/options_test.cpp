#include "clients/record/options.h"

#include <gtest/gtest.h>

#include <vector>

namespace flexcast::record {
namespace {

std::variant<Options, int> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "flexcast-record");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  auto parsed = parse_options(static_cast<int>(arguments.size()), arguments.data());
  testing::internal::GetCapturedStdout();
  testing::internal::GetCapturedStderr();
  return parsed;
}

TEST(Options, HaveTheDefaultsTheHelpTells) {
  const auto parsed = parse({"-o", "run.mcap"});
  const auto& options = std::get<Options>(parsed);
  EXPECT_EQ(options.file, "run.mcap");
  EXPECT_EQ(options.world, "");
  EXPECT_EQ(options.domain, 0);
  EXPECT_FALSE(options.frames);
  EXPECT_FALSE(options.duration);
  EXPECT_EQ(options.compression, mcap::Compression::kLz4);
  EXPECT_EQ(options.wait, 10);
  EXPECT_FALSE(options.force);
  EXPECT_FALSE(options.json);
}

TEST(Options, AnIdentityIsAFolder) {
  EXPECT_EQ(std::get<Options>(parse({"-o", "run.mcap"})).security, "");
  EXPECT_EQ(std::get<Options>(parse({"-o", "run.mcap", "--security", "keys/eye"})).security, "keys/eye");
}

TEST(Options, AreTakenFromTheCommandLine) {
  const auto parsed = parse({"-o", "run.mcap", "--world", "beam", "--domain", "7", "--profile", "lan", "--frames",
                             "100", "--compression", "zstd", "--wait", "0.5", "--force", "--json"});
  const auto& options = std::get<Options>(parsed);
  EXPECT_EQ(options.world, "beam");
  EXPECT_EQ(options.domain, 7);
  EXPECT_EQ(options.profile, "lan");
  EXPECT_EQ(options.frames, 100u);
  EXPECT_EQ(options.compression, mcap::Compression::kZstd);
  EXPECT_EQ(options.wait, 0.5);
  EXPECT_TRUE(options.force);
  EXPECT_TRUE(options.json);
  EXPECT_EQ(std::get<Options>(parse({"-o", "run.mcap", "--duration", "2.5"})).duration, 2.5);
}

TEST(Options, NameTheRecorderItsPartsAndItsStart) {
  const auto parsed =
      parse({"-o", "run.mcap", "--id", "left_1", "--paused", "--split-size", "64MB", "--security", "me"});
  const auto& options = std::get<Options>(parsed);
  EXPECT_EQ(options.id, "left_1");
  EXPECT_TRUE(options.paused);
  EXPECT_EQ(options.split_size, 64'000'000u);
  EXPECT_EQ(options.security, "me");
  EXPECT_EQ(std::get<Options>(parse({"-o", "run.mcap", "--keep-last", "30"})).keep_last, 30.0);
}

TEST(Options, NeedNoOutputToRecover) {
  const auto parsed = parse({"--recover", "run.mcap", "--json"});
  const auto& options = std::get<Options>(parsed);
  EXPECT_TRUE(options.recover);
  EXPECT_EQ(options.file, "run.mcap");
  EXPECT_TRUE(options.json);
}

TEST(Options, EndWithZeroAfterHelpAndVersion) {
  EXPECT_EQ(std::get<int>(parse({"--help"})), 0);
  EXPECT_EQ(std::get<int>(parse({"--version"})), 0);
}

class BadUsage : public testing::TestWithParam<std::vector<const char*>> {};

TEST_P(BadUsage, EndsWithTwo) {
  const auto parsed = parse(GetParam());
  ASSERT_TRUE(std::holds_alternative<int>(parsed));
  EXPECT_EQ(std::get<int>(parsed), 2);
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, BadUsage,
    testing::Values(std::vector<const char*>{}, std::vector{"-o"}, std::vector{"-o", "a.mcap", "--frames", "0"},
                    std::vector{"-o", "a.mcap", "--frames", "-3"}, std::vector{"-o", "a.mcap", "--duration", "0"},
                    std::vector{"-o", "a.mcap", "--duration", "nan"},
                    std::vector{"-o", "a.mcap", "--duration", "1e300"},
                    std::vector{"-o", "a.mcap", "--frames", "3", "--duration", "2"},
                    std::vector{"-o", "a.mcap", "--wait", "soon"}, std::vector{"-o", "a.mcap", "--domain", "231"},
                    std::vector{"-o", "a.mcap", "--compression", "bz2"},
                    std::vector{"-o", "a.mcap", "--split-size", "3"}, std::vector{"-o", "a.mcap", "beam"},
                    std::vector{"-o", "a.mcap", "--split-size", "much"}, std::vector{"-o", "a.mcap", "--id", "a b"},
                    std::vector{"-o", "a.mcap", "--keep-last", "0"},
                    std::vector{"-o", "a.mcap", "--keep-last", "3", "--split-size", "5MB"},
                    std::vector{"-o", "a.mcap", "--recover", "a.mcap"}, std::vector{"--recover"}));

}  // namespace
}  // namespace flexcast::record
