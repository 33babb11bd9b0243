// The command line of flexcast-lab.
#include "core/lab/options.h"

#include <gtest/gtest.h>

namespace flexcast::test {
namespace {

RunOptions parsed(const std::vector<std::string>& arguments) {
  const LabCommand command = parse_lab_command(arguments);
  if (const auto* end = std::get_if<CommandLineEnd>(&command)) {
    ADD_FAILURE() << end->text;
    return {};
  }
  return std::get<RunOptions>(command);
}

CommandLineEnd ended(const std::vector<std::string>& arguments) {
  const LabCommand command = parse_lab_command(arguments);
  const auto* end = std::get_if<CommandLineEnd>(&command);
  if (!end) ADD_FAILURE() << "the command line was accepted";
  return end ? *end : CommandLineEnd{"", -1};
}

TEST(LabOptions, OfRunAreAllUnderstood) {
  const RunOptions options = parsed({"run", "a.toml", "--until", "2.5", "--set", "gravity=[0, 0, -3]", "--set",
                                     "time.integrator=rk4", "--csv", "frames.csv", "--positions", "p.txt", "--json"});
  EXPECT_EQ(options.scene, "a.toml");
  EXPECT_EQ(options.until, 2.5);
  EXPECT_FALSE(options.steps);
  EXPECT_EQ(options.overrides, (std::vector<std::string>{"gravity=[0, 0, -3]", "time.integrator=rk4"}));
  EXPECT_EQ(options.csv, "frames.csv");
  EXPECT_EQ(options.positions, "p.txt");
  EXPECT_TRUE(options.json);
}

TEST(LabOptions, MayFollowOrPrecedeTheScene) {
  EXPECT_EQ(parsed({"run", "--steps", "0", "--set", "a=[1,2]", "a.toml"}).scene, "a.toml");
  EXPECT_EQ(parsed({"run", "--set", "a.b=-1", "a.toml", "--steps", "12"}).steps, 12);
  EXPECT_EQ(parsed({"run", "--set=a.b=1", "a.toml"}).overrides, std::vector<std::string>{"a.b=1"});
}

TEST(LabOptions, HelpHasAnExampleAndVersionIsTold) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"run", "--help"}}) {
    const CommandLineEnd end = ended(arguments);
    EXPECT_EQ(end.exit_code, 0);
    EXPECT_NE(end.text.find("flexcast-lab run server/scenes/cantilever.toml --until 2"), std::string::npos) << end.text;
  }
  EXPECT_EQ(ended({"--version"}).exit_code, 0);
  EXPECT_EQ(ended({"--version"}).text, "flexcast-lab " FLEXCAST_VERSION "\n");
}

TEST(LabOptions, ThatAreWrongEndWithTwo) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"run"},
      {"walk", "a.toml"},
      {"run", "a.toml", "--stepps", "3"},
      {"run", "a.toml", "--steps", "-3"},
      {"run", "a.toml", "--steps", "2.5"},
      {"run", "a.toml", "--steps", "many"},
      {"run", "a.toml", "--until", "-1"},
      {"run", "a.toml", "--until", "nan"},
      {"run", "a.toml", "--until", "inf"},
      {"run", "a.toml", "--until", "1", "--steps", "3"},
      {"run", "a.toml", "--set", "time.step"},
      {"run", "a.toml", "--set", "=3"},
      {"run", "a.toml", "--csv"},
      {"run", "a.toml", "b.toml"},
  };
  for (const auto& arguments : wrong) {
    const CommandLineEnd end = ended(arguments);
    EXPECT_EQ(end.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_FALSE(end.text.empty()) << testing::PrintToString(arguments);
  }
}

}  // namespace
}  // namespace flexcast::test
