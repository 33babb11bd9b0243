// Numerical trouble stops the world in a named state; the server lives on and the world can be revived.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/system/recording.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

using FailureSystem = SystemTest;

void expect_finite(const Recording& recording) {
  const auto finite = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](const auto value) { return std::isfinite(value); });
  };
  for (const FrameMessage& frame : recording.frames) {
    EXPECT_FALSE(frame.positions.empty() || frame.velocities.empty());
    ASSERT_TRUE(finite(frame.positions) && finite(frame.velocities) && finite(frame.bounds)) << "frame " << frame.frame;
  }
}

TEST_F(FailureSystem, SceneThatBlowsUpFailsByNameAndCanBeRevived) {
  // The stable step is near 1e-3 s.
  const std::string text =
      rope_scene("rope", "0.02", "5000.0") + "[stream]\nfields = [\"positions\", \"velocities\"]\n";
  const auto server = start_server(write_file("rope.toml", text), {"--paused"});
  auto connection = connect();
  const auto recorder = start_recorder("run.mcap");
  wait_for_frames(1);
  applied(connection.resume());
  wait_for_status(connection, [](const auto& status) { return status.state == flexcast_WORLD_FAILED; });

  const Json failed = ctl_json({"status"});
  EXPECT_EQ(failed["state"], "failed");
  const Json& failure = failed["failure"];
  const auto good_step = failed["step"].get<std::uint64_t>();
  EXPECT_FALSE(failure["cause"].get<std::string>().empty());
  EXPECT_EQ(failure["body"], "rope");
  EXPECT_GE(failure["element"], 0);
  EXPECT_LT(failure["element"], 10);
  EXPECT_EQ(failure["step"], good_step + 1);
  for (const Json& coordinate : failure["position"]) EXPECT_TRUE(coordinate.is_number());
  EXPECT_NE(failure["suggestion"].get<std::string>().find("time.step"), std::string::npos);
  EXPECT_NE(ctl({"status"}).out.find("rope, element"), std::string::npos);
  EXPECT_EQ(ctl({"resume"}).code, 1);
  EXPECT_FALSE(failed["warnings"].empty());  // the margin was below one all the time

  // A smaller step goes on from the last good state.
  const Json set = ctl_json({"set", "time.step=0.0001"});
  EXPECT_EQ(set["state"], "paused");
  EXPECT_EQ(set["applied_step"], good_step);
  ctl_json({"reset", "--keep-parameters"});
  ctl_json({"resume"});
  const auto alive = wait_for_status(connection, [](const auto& status) { return status.report.step > 1000; });
  EXPECT_EQ(alive->state, flexcast_WORLD_RUNNING);

  // Back to the scene's step: it fails again, at the same one.
  ctl_json({"reset"});
  const auto again =
      wait_for_status(connection, [](const auto& status) { return status.state == flexcast_WORLD_FAILED; });
  EXPECT_EQ(again->report.step, good_step);
  end(*server, SIGTERM);
  end_recorder(*recorder);

  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  expect_finite(recording);
  ASSERT_EQ(recording.run_ids().size(), 3U);
  const auto frames = recording.frames_of(recording.run_ids()[0]);
  expect_contiguous(frames, 0);
  EXPECT_EQ(frames.back().step, good_step);
  const auto is_failure = [](const EventMessage& event) { return event.state == flexcast_WORLD_FAILED; };
  EXPECT_GE(std::count_if(recording.events.begin(), recording.events.end(), is_failure), 2);
}

TEST_F(FailureSystem, SmallerStepAfterAFailureGoesOnFromTheLastGoodState) {
  // Just above the stable step: it takes a while to blow up, and the state before is tame.
  const auto server = start_server(write_file("rope.toml", rope_scene("rope", "0.02", "5000.0")), {"--rate", "max"});
  auto connection = connect();
  const auto failed =
      wait_for_status(connection, [](const auto& status) { return status.state == flexcast_WORLD_FAILED; });
  // From speeds near 1e38 m/s no step is small enough but one that is almost none.
  const auto set = applied(connection.set({{"time.step", 1e-12}, {"rope.damping", 0.0}}));
  EXPECT_EQ(set.applied_step, failed->report.step);
  EXPECT_EQ(set.state, flexcast_WORLD_PAUSED);
  const auto stepped = applied(connection.step(1, patience));
  EXPECT_EQ(stepped.applied_step, failed->report.step + 1);
  EXPECT_TRUE(server->runs());
}

}  // namespace
}  // namespace flexcast::test
