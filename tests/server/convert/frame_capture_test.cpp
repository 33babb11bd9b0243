#include "server/convert/frame_capture.h"

#include <gtest/gtest.h>

namespace flexcast::server {
namespace {

State make_state(std::int64_t particles, double first) {
  State state;
  state.positions = VecX::LinSpaced(3 * particles, first, first + 1.0);
  state.velocities = VecX::LinSpaced(3 * particles, -1.0, first);
  return state;
}

TEST(FrameCapture, KeepsHeaderNumbersAndTheHashOfTheDoubles) {
  const State state = make_state(1000, 0.1);
  FrameHeader header;
  header.frame = 12;
  header.step = 13;
  header.format.velocities = true;
  FrameCapture capture;
  Frame frame;
  capture.fill(header, state, nullptr, frame);
  EXPECT_EQ(frame.header.frame, 12u);
  EXPECT_EQ(frame.particles, 1000u);
  EXPECT_EQ(frame.state_hash, calc_state_hash(13, state.positions, state.velocities));
  EXPECT_EQ(frame.payload.positions[7], static_cast<float>(state.positions[7]));
  EXPECT_EQ(frame.payload.velocities[2999], static_cast<float>(state.velocities[2999]));
}

TEST(FrameCapture, AFrameUsedAgainIsTheNewStatesAlone) {
  FrameCapture capture;
  Frame used, fresh;
  capture.fill({.step = 1, .format = {.velocities = true}}, make_state(100, 5.0), nullptr, used);
  const State state = make_state(7, 2.0);
  const FrameHeader header{.step = 2, .format = {.precision = StreamPrecision::float64}};
  capture.fill(header, state, nullptr, used);
  FrameCapture().fill(header, state, nullptr, fresh);
  EXPECT_EQ(used.particles, 7u);
  EXPECT_EQ(used.state_hash, fresh.state_hash);
  EXPECT_EQ(used.payload.bounds, fresh.payload.bounds);
  EXPECT_EQ(used.payload.positions64, fresh.payload.positions64);
  EXPECT_TRUE(used.payload.positions.empty() && used.payload.velocities.empty());
}

}  // namespace
}  // namespace flexcast::server
