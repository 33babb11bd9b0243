#include "clients/web/options.h"

#include <gtest/gtest.h>

#include <sstream>

namespace flexcast::web {
namespace {

std::variant<Options, int> parse(std::vector<const char*> arguments) {
  std::ostringstream out, err;
  arguments.insert(arguments.begin(), "flexcast-web");
  return parse_options(static_cast<int>(arguments.size()), arguments.data(), out, err);
}

TEST(WebOptions, ByDefaultThisMachineAlone) {
  const auto options = std::get<Options>(parse({}));
  EXPECT_EQ(options.net.bind, "127.0.0.1");
  EXPECT_EQ(options.net.port, 8080);
  EXPECT_TRUE(options.origins.empty());
}

TEST(WebOptions, OriginsMayBeRepeated) {
  const auto options = std::get<Options>(parse({"--allow-origin", "https://a", "--port", "0", "--allow-origin", "*"}));
  EXPECT_EQ(options.origins, (std::vector<std::string>{"https://a", "*"}));
  EXPECT_EQ(options.net.port, 0);
}

TEST(WebOptions, BadUsageEndsWithTwo) {
  EXPECT_EQ(std::get<int>(parse({"--port", "65536"})), 2);
  EXPECT_EQ(std::get<int>(parse({"--port", "-1"})), 2);
  EXPECT_EQ(std::get<int>(parse({"--domain", "231"})), 2);
  EXPECT_EQ(std::get<int>(parse({"extra"})), 2);
  EXPECT_EQ(std::get<int>(parse({"--help"})), 0);
}

}  // namespace
}  // namespace flexcast::web
