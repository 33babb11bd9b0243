// The example of the README (example.h is what it shows) against a server.
#include "tests/clients/client/example.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/support/fake_server.h"

namespace flexcast::client {
namespace {

std::string read(const std::string& path) {
  std::ifstream file(std::string(FLEXCAST_SOURCE_DIR) + "/" + path);
  return std::move(std::ostringstream() << file.rdbuf()).str();
}

TEST(Example, WaitsForAFrameThatMeetsItsCondition) {
  const test::FakeServer server("rope");
  std::jthread motion([&](const std::stop_token& stop) {
    for (std::uint64_t frame = 0; !stop.stop_requested(); ++frame) {
      server.publish(1, frame);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  EXPECT_TRUE(rope_follows_gravity(test::test_domain()));
}

TEST(Example, IsWhatTheReadmeShows) {
  const std::string readme = read("README.md"), header = read("tests/clients/client/example.h");
  EXPECT_NE(readme.find(header.substr(header.find("#include"))), std::string::npos);
}

}  // namespace
}  // namespace flexcast::client
