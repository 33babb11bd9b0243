#include "clients/web/gate.h"

#include <gtest/gtest.h>

namespace flexcast::web {
namespace {

TEST(Gate, OnlyAddressesLocalhostAndTheBoundNameAreHosts) {
  const Gate gate("studio.lan", {});
  for (const char* host : {"localhost", "LOCALHOST:8080", "127.0.0.1", "127.0.0.1:8080", "192.168.1.5:80", "[::1]",
                           "[::1]:8080", "studio.lan:8080"})
    EXPECT_TRUE(gate.admits_host(host)) << host;
  for (const char* host : {"", ":8080", "evil.com", "evil.com:8080", "localhost.evil.com", "127.0.0.1.evil.com",
                           "localhost:x", "localhost:", "[::1", "[evil.com]", "[::1]x", "127.0.0.1:80:80", "::1"})
    EXPECT_FALSE(gate.admits_host(host)) << host;
}

TEST(Gate, OnlyItsOwnAndAllowedPagesMayConnect) {
  const Gate gate("127.0.0.1", {"https://app.foxglove.dev"});
  EXPECT_TRUE(gate.admits_origin("", "localhost:8080"));
  EXPECT_TRUE(gate.admits_origin("http://localhost:8080", "localhost:8080"));
  EXPECT_TRUE(gate.admits_origin("https://localhost:8080", "localhost:8080"));
  EXPECT_TRUE(gate.admits_origin("https://app.foxglove.dev", "localhost:8080"));
  for (const char* origin : {"http://evil.com", "http://localhost:8081", "http://localhost", "null",
                             "https://app.foxglove.dev.evil.com", "http://app.foxglove.dev", "localhost:8080"})
    EXPECT_FALSE(gate.admits_origin(origin, "localhost:8080")) << origin;
  EXPECT_TRUE(Gate("127.0.0.1", {"*"}).admits_origin("http://evil.com", "localhost"));
}

}  // namespace
}  // namespace flexcast::web
