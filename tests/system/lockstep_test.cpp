// A server in lockstep waits for its recorders: they get every frame, however slow they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/support/lockstep_recorder.h"
#include "tests/support/network.h"
#include "tests/system/recording.h"
#include "tests/system/replay.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

using Taken = LockstepRecorder::Taken;

class LockstepSystem : public SystemTest {
 protected:
  // Runs a world of so many steps as fast as it can and takes its frames, a millisecond apart (with FLEXCAST_LONG a
  // hundred times as long as a step).
  std::vector<Taken> record(const std::filesystem::path& scene, std::uint64_t steps) const;
};

std::vector<Taken> LockstepSystem::record(const std::filesystem::path& scene, std::uint64_t steps) const {
  const auto server = start_server(scene, {"--lockstep=1", "--rate", "max", "--until",
                                           std::to_string(0.001 * static_cast<double>(steps)), "--exit"});
  const auto participant = wire::Participant::create({.domain = domain()}).value();
  LockstepRecorder recorder(participant, "sheet", "slow");
  std::vector<Taken> taken;
  while (const auto frame = recorder.next(patience)) {
    std::this_thread::sleep_for(std::getenv("FLEXCAST_LONG") != nullptr ? 8ms : 1ms);
    taken.push_back(*frame);
    recorder.acknowledge(*frame);
    if (frame->frame == steps) break;
  }
  EXPECT_EQ(server->wait(patience), 0);  // when the last frame is in hand
  return taken;
}

// A step of this sheet takes less than a tenth of a millisecond, and all queues on the way together do not hold the
// frames (20 KB).
TEST_F(LockstepSystem, ARecorderFarSlowerThanTheWorldGetsEveryFrameInEveryRun) {
  const auto scene = write_file("sheet.toml", sheet_scene(40));
  constexpr std::uint64_t steps = 1000;
  const auto truth = calc_hashes(scene, steps);
  for (int repeat = 0; repeat < 2; ++repeat) {
    const auto taken = record(scene, steps);
    ASSERT_EQ(taken.size(), steps + 1);
    for (std::size_t i = 0; i < taken.size(); ++i) {
      ASSERT_EQ(taken[i].frame, i);
      ASSERT_EQ(taken[i].state_hash, truth[i]);
    }
  }
}

// The recorder stands still most of the time: it is stopped for 45 of every 50 ms.
void stutter(Process& recorder) {
  for (int i = 0; i < 1000 && recorder.runs(); ++i) {
    recorder.send(SIGSTOP);
    std::this_thread::sleep_for(45ms);
    recorder.send(SIGCONT);
    std::this_thread::sleep_for(5ms);
  }
}

TEST_F(LockstepSystem, EveryRunGivesAFileWithTheSameFramesHoweverOftenTheRecorderIsStopped) {
  const auto scene = write_file("rope.toml", rope_scene());
  constexpr std::uint64_t steps = 500;
  const auto truth = calc_hashes(scene, steps);
  const int runs = std::getenv("FLEXCAST_LONG") != nullptr ? 20 : 3;
  for (int run = 0; run < runs; ++run) {
    const auto server = start_server(scene, {"--lockstep=1", "--rate", "max", "--until", "0.5", "--exit"});
    const std::string file = "run" + std::to_string(run) + ".mcap";
    const auto recorder = start_recorder(file, {"--frames", std::to_string(steps + 1)});
    stutter(*recorder);
    EXPECT_EQ(await_recorder(*recorder).at("gaps"), 0);
    EXPECT_EQ(server->wait(patience), 0);
    EXPECT_EQ(hashes_of(read_recording(path(file)).frames), truth) << file;
  }
}

TEST_F(LockstepSystem, AResetAmidTheRunLosesNoFrameOfEitherRun) {
  const auto server = start_server(write_file("rope.toml", rope_scene()), {"--lockstep=1", "--rate", "max"});
  const auto participant = wire::Participant::create({.domain = domain()}).value();
  LockstepRecorder recorder(participant, "rope", "slow");
  auto connection = connect();
  std::uint64_t resets = 0;
  std::optional<Taken> before;
  while (const auto frame = recorder.next(patience)) {
    if (before && frame->run_id == before->run_id) {
      ASSERT_EQ(frame->frame, before->frame + 1);
    } else {
      ASSERT_EQ(frame->frame, 0U);
    }
    before = *frame;
    if (frame->frame == 20 && resets < 3) {
      applied(connection.reset());  // while the frames up to the window's end are under way
      ++resets;
    }
    std::this_thread::sleep_for(1ms);
    recorder.acknowledge(*frame);
    if (frame->frame == 100) break;
  }
  EXPECT_EQ(resets, 3U);
}

TEST(LockstepChild, DISABLED_HasOneFrameAndNeverAnother) {
  const auto participant = join_test_domain();
  LockstepRecorder recorder(participant, "rope", "dead");
  recorder.acknowledge(recorder.next(patience).value());
  std::puts("has a frame");
  std::fflush(stdout);
  std::this_thread::sleep_for(60s);
}

TEST_F(LockstepSystem, AKilledRecorderHoldsTheWorldNoLongerThanItsLease) {
  const auto server = start_server(write_file("rope.toml", rope_scene()), {"--lockstep=1", "--rate", "max"});
  auto connection = connect();
  setenv("FLEXCAST_TEST_DOMAIN", std::to_string(domain()).c_str(), 1);
  Process recorder("/proc/self/exe", {"--gtest_filter=LockstepChild.*", "--gtest_also_run_disabled_tests"});
  unsetenv("FLEXCAST_TEST_DOMAIN");
  ASSERT_TRUE(recorder.wait_for_line("has a frame", patience));
  const auto held = wait_for_status(connection, [](const flexcast_Status& status) {
    const auto warnings = wire::strings(status.warnings);
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& text) { return text.find("'dead'") != std::string::npos; });
  });
  EXPECT_LT(held->report.step, 64U);
  EXPECT_EQ(held->state, flexcast_WORLD_RUNNING);
  applied(connection.set({{"rope.stiffness", 40.0}}));  // commands go on
  const auto still = wait_for_status(
      connection, [&](const flexcast_Status& status) { return status.heartbeat > held->heartbeat + 10; });
  EXPECT_EQ(still->report.step, held->report.step);
  recorder.send(SIGKILL);
  wait_for_status(connection, [](const flexcast_Status& status) {
    return status.report.step > 1000 && status.warnings._length == 0;
  });
}

}  // namespace
}  // namespace flexcast::test
