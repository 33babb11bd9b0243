// A recorder keeps up with large frames for as long as it is asked to.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/system/recording.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

using LongRecordingSystem = SystemTest;

// 200,000 particles, 2.4 MB a frame, 60 steps a second; a chain takes little of the machine, which is there for the stream.
constexpr const char* long_rope = R"(name = "long"
[time]
step = 0.016666666666666666
integrator = "symplectic_euler"

[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [199999], size = [200.0] }
springs = { stiffness = 0.001 }
mass = 0.01
velocity = [ { select = { box = [[0.0, -1.0, -1.0], [10.0, 1.0, 1.0]] }, value = [0.0, 0.0, 0.5] } ]
)";

// A minute, with FLEXCAST_LONG ten. The last seconds stay on the disk; the account is of everything.
TEST_F(LongRecordingSystem, LargeFramesSixtyTimesASecondAreAllThere) {
  const std::uint64_t frames = std::getenv("FLEXCAST_LONG") != nullptr ? 36000 : 3600;
  const auto server = start_server(write_file("long.toml", long_rope), {"--paused"});
  auto connection = connect();
  const auto recorder = start_recorder("long.mcap", {"--keep-last", "2"});
  wait_for_frames(1);
  applied(connection.resume());
  std::uint64_t seen = 0;
  for (std::uint64_t next = 600; next <= frames; next += 600) {  // ten seconds, so that `patience` is for each
    wait_for_recorder([&](const flexcast_RecorderInfo& info) {
      EXPECT_EQ(info.gaps, 0U) << "of the frames before " << info.next_frame;
      seen = info.next_frame;
      return info.next_frame > next || info.gaps > 0;
    });
    if (HasFailure()) break;
  }
  EXPECT_GT(seen, frames);
  const Json summary = end_recorder(*recorder);
  EXPECT_EQ(summary["gaps"], 0);
  const Recording recording = read_recording(path("long.mcap"));
  expect_complete(recording);
  EXPECT_GT(recording.frames.size(), 60U);
}

}  // namespace
}  // namespace flexcast::test
