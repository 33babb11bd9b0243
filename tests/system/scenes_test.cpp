// The scenes that come with the server.
#include <gtest/gtest.h>

#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

namespace fs = std::filesystem;
using ScenesSystem = SystemTest;

TEST_F(ScenesSystem, EverySceneStartsAndStreams) {
  std::size_t scenes = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(FLEXCAST_SOURCE_DIR) / "server/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path());
    ++scenes;
    const auto server = start_server(entry.path(), {"--rate", "max"});
    auto connection = connect(entry.path().stem());
    auto frames = connection.frames().value();
    std::uint64_t last = 0;
    for (int i = 0; i < 3; ++i) {
      const auto frame = frames.next(patience);
      ASSERT_TRUE(frame);
      EXPECT_GT(frame->particles, 0U);
      EXPECT_EQ(frame->positions.size(), 3 * frame->particles);
      EXPECT_TRUE(i == 0 || frame->frame > last);
      last = frame->frame;
    }
    EXPECT_EQ(applied(connection.send({.kind = flexcast_COMMAND_STATUS})).state, flexcast_WORLD_RUNNING);
    end(*server, SIGTERM);
  }
  EXPECT_GE(scenes, 6U);
}

}  // namespace
}  // namespace flexcast::test
