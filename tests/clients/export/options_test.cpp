#include "clients/export/options.h"

#include <gtest/gtest.h>

namespace flexcast::exporting {
namespace {

std::variant<Options, int> parse(std::vector<const char*> words) {
  words.insert(words.begin(), "flexcast-export");
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  auto parsed = parse_options(static_cast<int>(words.size()), words.data());
  testing::internal::GetCapturedStdout();
  testing::internal::GetCapturedStderr();
  return parsed;
}

TEST(ExportOptions, EveryOptionIsTaken) {
  const auto options =
      std::get<Options>(parse({"run.mcap", "--vtk", "out", "--run", "2", "--from", "1", "--to", "2.5", "--every", "10",
                               "--fields", "velocities,stress", "--force", "--json"}));
  EXPECT_EQ(options.file, "run.mcap");
  EXPECT_EQ(options.vtk, "out");
  EXPECT_EQ(options.run, 2U);
  EXPECT_EQ(options.from, 1.0);
  EXPECT_EQ(options.to, 2.5);
  EXPECT_EQ(options.every, 10U);
  EXPECT_EQ(options.fields, (std::vector<std::string>{"velocities", "stress"}));
  EXPECT_TRUE(options.force && options.json);
}

TEST(ExportOptions, WithoutMoreItIsTheLastRunWithAllItsFramesAndFields) {
  const auto options = std::get<Options>(parse({"run.mcap", "--csv", "tip.csv"}));
  EXPECT_EQ(options.csv, "tip.csv");
  EXPECT_FALSE(options.run || options.from || options.to || options.force || options.json);
  EXPECT_EQ(options.every, 1U);
  EXPECT_TRUE(options.fields.empty());
}

TEST(ExportOptions, HelpAndVersionEndWellBadUsageDoesNot) {
  EXPECT_EQ(std::get<int>(parse({"--help"})), 0);
  EXPECT_EQ(std::get<int>(parse({"--version"})), 0);
  for (const auto& words :
       std::vector<std::vector<const char*>>{{"--vtk", "out"},
                                             {"run.mcap"},
                                             {"run.mcap", "--vtk", "out", "--csv", "tip.csv"},
                                             {"run.mcap", "--vtk", "out", "--run", "0"},
                                             {"run.mcap", "--vtk", "out", "--every", "0"},
                                             {"run.mcap", "--vtk", "out", "--from", "2", "--to", "1"},
                                             {"run.mcap", "--vtk", "out", "--fields", "colour"}}) {
    const auto parsed = parse(words);
    ASSERT_TRUE(std::holds_alternative<int>(parsed)) << words.back();
    EXPECT_EQ(std::get<int>(parsed), 2) << words.back();
  }
}

}  // namespace
}  // namespace flexcast::exporting
