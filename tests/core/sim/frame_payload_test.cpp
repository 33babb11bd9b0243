// What is sent of a state, and what a viewer makes of it.
#include "core/sim/frame_payload.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace flexcast {
namespace {

using enum StreamPrecision;

const VecX none;

VecX make_random(std::int64_t numbers, double scale = 10.0) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-scale, scale);
  return VecX::NullaryExpr(numbers, [&] { return uniform(random); });
}

FramePayload make_payload(const VecX& positions, const VecX& velocities, const StreamFormat& format) {
  FramePayload payload;
  fill_payload({positions, velocities, none, none}, format, payload);
  return payload;
}

// The largest error of each axis in quanta; of an axis without extent in metres.
Vec3 calc_errors(const VecX& positions, const FramePayload& payload) {
  const VecX decoded = decode_positions(payload);
  EXPECT_EQ(decoded.size(), positions.size());
  Vec3 errors = Vec3::Zero();
  for (Eigen::Index i = 0; i < positions.size(); ++i) {
    const std::size_t axis = static_cast<std::size_t>(i % 3);
    const double quantum = (payload.bounds[axis + 3] - payload.bounds[axis]) / 65535.0;
    const double error = std::abs(decoded[i] - positions[i]);
    errors[i % 3] = std::max(errors[i % 3], quantum > 0.0 ? error / quantum : error);
  }
  return errors;
}

TEST(FramePayload, QuantizedPositionsAreHalfAQuantumOffAtMost) {
  VecX positions = make_random(3000);
  for (Eigen::Index i = 1; i < positions.size(); i += 3) positions[i] = 1e-6 * positions[i] + 100.0;
  const Vec3 errors = calc_errors(positions, make_payload(positions, none, {.precision = quantized16}));
  EXPECT_LE(errors.maxCoeff(), 0.5 + 1e-4);  // 1e-4: the y coordinates are rounded to 2^-46 m themselves
  EXPECT_GT(errors.minCoeff(), 0.45);        // and no better: rounding is to the nearest
}

TEST(FramePayload, TheCornersOfTheBoundsAreTheFirstAndTheLastFraction) {
  const VecX positions = (VecX(9) << -1, 2, 5, 3, 4, 6, 1, 3, 5.25).finished();
  const FramePayload payload = make_payload(positions, none, {.precision = quantized16});
  EXPECT_EQ(payload.bounds, (std::array<double, 6>{-1, 2, 5, 3, 4, 6}));
  EXPECT_EQ(payload.positions16, (std::vector<std::uint16_t>{0, 0, 0, 65535, 65535, 65535, 32768, 32768, 16384}));
  EXPECT_EQ(decode_positions(payload).segment(3, 3), positions.segment(3, 3));
}

TEST(FramePayload, AFlatBoxIsExactAlongItsFlatAxis) {
  VecX positions = make_random(300);
  for (Eigen::Index i = 2; i < positions.size(); i += 3) positions[i] = 0.1;
  const Vec3 errors = calc_errors(positions, make_payload(positions, none, {.precision = quantized16}));
  EXPECT_EQ(errors[2], 0.0);
  EXPECT_LE(errors.maxCoeff(), 0.5 + 1e-9);
}

TEST(FramePayload, OneParticleIsExact) {
  const VecX positions = Vec3(0.1, -7.3, 1e30);
  const FramePayload payload = make_payload(positions, none, {.precision = quantized16});
  EXPECT_EQ(payload.positions16, (std::vector<std::uint16_t>{0, 0, 0}));
  EXPECT_EQ(decode_positions(payload), positions);
}

TEST(FramePayload, ExtremeBoxesStayFinite) {
  for (const double scale : {1e38, 1e-300, 5e-324}) {
    const VecX positions = (VecX(9) << -scale, 0, scale, scale, scale, 0, 0, 0, 0).finished();
    const FramePayload payload = make_payload(positions, none, {.precision = quantized16});
    EXPECT_TRUE(decode_positions(payload).allFinite()) << scale;
    EXPECT_EQ(payload.positions16[3], 65535) << scale;
    EXPECT_EQ(payload.positions16[0], 0) << scale;
  }
}

TEST(FramePayload, QuantizedStreamsHaveVelocitiesInSinglePrecision) {
  const VecX positions = make_random(30), velocities = make_random(30, 3.0);
  const FramePayload payload = make_payload(positions, velocities, {.velocities = true, .precision = quantized16});
  EXPECT_EQ(payload.positions16.size(), 30u);
  ASSERT_EQ(payload.velocities.size(), 30u);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_EQ(payload.velocities[i], static_cast<float>(velocities[static_cast<Eigen::Index>(i)]));
  }
  EXPECT_TRUE(payload.positions.empty() && payload.positions64.empty() && payload.velocities64.empty());
}

TEST(FramePayload, OtherPrecisionsAreDecodedAsTheyWereSent) {
  const VecX positions = make_random(30);
  EXPECT_EQ(decode_positions(make_payload(positions, none, {.precision = float64})), positions);
  const VecX decoded = decode_positions(make_payload(positions, none, {}));
  for (Eigen::Index i = 0; i < 30; ++i) EXPECT_EQ(decoded[i], static_cast<double>(static_cast<float>(positions[i])));
}

TEST(FramePayload, WithoutPositionsHasBoundsAllTheSame) {
  const VecX positions = make_random(30);
  const FramePayload payload = make_payload(positions, positions, {.positions = false, .velocities = true});
  EXPECT_EQ(payload.bounds[0], std::min({positions[0], payload.bounds[0]}));
  EXPECT_LT(payload.bounds[0], payload.bounds[3]);
  EXPECT_EQ(decode_positions(payload).size(), 0);
}

TEST(FramePayload, ABufferUsedAgainShowsTheNewFrameAlone) {
  const VecX positions = make_random(30), fewer = make_random(6), stretch = VecX::Constant(10, 0.5);
  FramePayload payload;
  fill_payload({positions, positions, stretch, none}, {.velocities = true, .stretch = true}, payload);
  EXPECT_EQ(payload.stretch, std::vector<float>(10, 0.5f));
  fill_payload({fewer, fewer, none, none}, {.precision = quantized16}, payload);
  EXPECT_EQ(payload.positions16.size(), 6u);
  EXPECT_TRUE(payload.positions.empty() && payload.velocities.empty() && payload.stretch.empty());
}

// Blocks of any number, whole ones and a rest, and none at all.
TEST(FramePayload, TheHashOnTheWayIsTheStatesAndTheNumbersAreTheSameWithoutIt) {
  for (const std::int64_t particles : {0, 1, 2, 679, 680, 681, 1360, 2000, 10'001}) {
    const VecX positions = make_random(3 * particles), velocities = 2.0 * positions;
    for (const StreamPrecision precision : {float32, float64, quantized16}) {
      for (const bool moves : {false, true}) {
        const StreamFormat format{.velocities = moves, .precision = precision};
        StateHash hash;
        hash.begin(42);
        FramePayload hashed;
        fill_payload({positions, velocities, none, none}, format, hashed, &hash);
        EXPECT_EQ(hash.value(), calc_state_hash(42, positions, velocities)) << particles;
        const FramePayload payload = make_payload(positions, velocities, format);
        EXPECT_EQ(hashed.bounds, payload.bounds);
        EXPECT_EQ(hashed.positions, payload.positions);
        EXPECT_EQ(hashed.positions64, payload.positions64);
        EXPECT_EQ(hashed.positions16, payload.positions16);
        EXPECT_EQ(hashed.velocities, payload.velocities);
        EXPECT_EQ(hashed.velocities64, payload.velocities64);
      }
    }
  }
}

TEST(FramePayload, EveryNumberOfALargeFrameIsItsOwn) {
  const VecX positions = make_random(3 * 5000);
  const FramePayload floats = make_payload(positions, positions, {.velocities = true});
  const FramePayload doubles = make_payload(positions, positions, {.velocities = true, .precision = float64});
  ASSERT_EQ(floats.positions.size(), 15'000u);
  for (Eigen::Index i = 0; i < positions.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    ASSERT_EQ(floats.positions[k], static_cast<float>(positions[i]));
    ASSERT_EQ(floats.velocities[k], static_cast<float>(positions[i]));
    ASSERT_EQ(doubles.positions64[k], positions[i]);
    ASSERT_EQ(doubles.velocities64[k], positions[i]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = Eigen::Map<const VecX, 0, Eigen::InnerStride<3>>(positions.data() + axis, 5000);
    EXPECT_EQ(floats.bounds[static_cast<std::size_t>(axis)], along.minCoeff());
    EXPECT_EQ(floats.bounds[static_cast<std::size_t>(axis + 3)], along.maxCoeff());
  }
}

TEST(FramePayload, MemoryThatWasReservedIsNotMoved) {
  const VecX positions = make_random(3 * 1000);
  for (const StreamPrecision precision : {float32, float64, quantized16}) {
    const StreamFormat format{.velocities = true, .precision = precision};
    FramePayload payload;
    reserve_payload(1000, format, payload);
    const std::array<const void*, 5> before = {payload.positions.data(), payload.positions64.data(),
                                               payload.positions16.data(), payload.velocities.data(),
                                               payload.velocities64.data()};
    fill_payload({positions, positions, none, none}, format, payload);
    const std::array<const void*, 5> after = {payload.positions.data(), payload.positions64.data(),
                                              payload.positions16.data(), payload.velocities.data(),
                                              payload.velocities64.data()};
    EXPECT_EQ(before, after);
  }
}

TEST(StreamFormat, IsWhatTheSceneNames) {
  StreamSettings settings;
  settings.fields = {"stress", "velocities"};
  settings.precision = "quantized16";
  const StreamFormat format = make_stream_format(settings);
  EXPECT_FALSE(format.positions);
  EXPECT_TRUE(format.velocities && format.stress);
  EXPECT_FALSE(format.stretch);
  EXPECT_EQ(format.precision, quantized16);
}

}  // namespace
}  // namespace flexcast
