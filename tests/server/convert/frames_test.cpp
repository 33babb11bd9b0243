#include "server/convert/frames.h"

#include <gtest/gtest.h>

#include <random>

#include "core/sim/chunks.h"
#include "core/sim/frame_size.h"
#include "idl/wire/fill.h"

namespace flexcast::server {
namespace {

// A frame, and the numbers it was made of.
struct Shot {
  VecX positions, velocities, stretch, stress;
  Frame frame;
};

void fill(Shot& shot) {
  shot.frame.particles = static_cast<std::uint32_t>(shot.positions.size() / 3);
  fill_payload({shot.positions, shot.velocities, shot.stretch, shot.stress}, shot.frame.header.format,
               shot.frame.payload);
}

Shot make_shot(std::int64_t particles, const StreamFormat& format) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-10.0, 10.0);
  Shot shot;
  FrameHeader& header = shot.frame.header;
  header.run_id = 11;
  header.frame = 12;
  header.step = 13;
  header.time = 0.013;
  header.parameter_revision = 14;
  header.format = format;
  shot.frame.state_hash = 15;
  shot.positions = VecX::NullaryExpr(3 * particles, [&] { return uniform(random); });
  shot.velocities = VecX::NullaryExpr(3 * particles, [&] { return uniform(random); });
  shot.stretch = VecX::NullaryExpr(particles, [&] { return uniform(random); });
  shot.stress = VecX::NullaryExpr(particles, [&] { return 1e5 * uniform(random); });
  fill(shot);
  return shot;
}

constexpr StreamFormat all_floats{.velocities = true};
constexpr StreamFormat all_doubles{.velocities = true, .precision = StreamPrecision::float64};
constexpr StreamFormat everything_small{
    .velocities = true, .precision = StreamPrecision::quantized16, .stretch = true, .stress = true};

TEST(FrameMessage, CarriesTheHeaderAndTheHash) {
  const Shot shot = make_shot(100, {});
  FrameMessage message("rope");
  message.assign(shot.frame);
  ASSERT_EQ(message.chunks(), 1u);
  const auto& sample = message.chunk(0);
  EXPECT_EQ(wire::text(sample.world), "rope");
  EXPECT_EQ(sample.run_id, 11u);
  EXPECT_EQ(sample.frame, 12u);
  EXPECT_EQ(sample.step, 13u);
  EXPECT_EQ(sample.time, 0.013);
  EXPECT_EQ(sample.parameter_revision, 14u);
  EXPECT_EQ(sample.topology_revision, 1u);
  EXPECT_EQ(sample.total, 100u);
  EXPECT_EQ(sample.state_hash, 15u);
}

TEST(FrameMessage, FloatsAreTheDoublesRounded) {
  const Shot shot = make_shot(100, all_floats);
  FrameMessage message("rope");
  message.assign(shot.frame);
  const auto& sample = message.chunk(0);
  ASSERT_EQ(sample.positions._length, 300u);
  ASSERT_EQ(sample.velocities._length, 300u);
  for (int i = 0; i < 300; ++i) {
    EXPECT_EQ(sample.positions._buffer[i], static_cast<float>(shot.positions[i]));
    EXPECT_EQ(sample.velocities._buffer[i], static_cast<float>(shot.velocities[i]));
  }
}

TEST(FrameMessage, DoublesAreTheStatesOwn) {
  const Shot shot = make_shot(100, all_doubles);
  FrameMessage message("rope");
  message.assign(shot.frame);
  const auto& sample = message.chunk(0);
  EXPECT_EQ(sample.positions._length + sample.velocities._length, 0u);
  ASSERT_EQ(sample.positions64._length, 300u);
  ASSERT_EQ(sample.velocities64._length, 300u);
  for (int i = 0; i < 300; ++i) {
    EXPECT_EQ(sample.positions64._buffer[i], shot.positions[i]);
    EXPECT_EQ(sample.velocities64._buffer[i], shot.velocities[i]);
  }
}

TEST(FrameMessage, SendsNoFieldThatWasNotAskedFor) {
  const Shot shot = make_shot(10, {});
  FrameMessage message("rope");
  message.assign(shot.frame);
  const auto& sample = message.chunk(0);
  EXPECT_EQ(sample.positions._length, 30u);
  EXPECT_EQ(sample.velocities._length, 0u);
  EXPECT_EQ(sample.positions64._length + sample.velocities64._length + sample.positions16._length, 0u);
  EXPECT_EQ(sample.stretch._length + sample.stress._length, 0u);
}

TEST(FrameMessage, BoundsAreThoseOfAllParticles) {
  Shot shot = make_shot(1000, {});
  block3(shot.positions, 3) = Vec3(-20, 0, 0);
  block3(shot.positions, 999) = Vec3(0, 30, -40);
  fill(shot);
  FrameMessage message("rope");
  message.assign(shot.frame);
  const auto& bounds = message.chunk(0).bounds;
  for (int axis = 0; axis < 3; ++axis) {
    double low = 1e9;
    double high = -1e9;
    for (int i = 0; i < 1000; ++i) {
      low = std::min(low, shot.positions[3 * i + axis]);
      high = std::max(high, shot.positions[3 * i + axis]);
    }
    EXPECT_EQ(bounds[axis], low);
    EXPECT_EQ(bounds[axis + 3], high);
  }
}

TEST(FrameMessage, ChunksCoverEveryParticleExactlyOnceAndStayBelowOneMebibyte) {
  constexpr std::uint32_t particles = 300'001;
  const Shot shot = make_shot(particles, all_floats);
  FrameMessage message("rope");
  message.assign(shot.frame);
  EXPECT_EQ(message.chunks(), 7u);  // 7.2 MB
  std::uint32_t next = 0;
  for (std::uint32_t chunk = 0; chunk < message.chunks(); ++chunk) {
    const auto& sample = message.chunk(chunk);
    EXPECT_EQ(sample.chunk, chunk);
    EXPECT_EQ(sample.first, next);
    EXPECT_EQ(sample.total, particles);
    EXPECT_EQ(sample.positions._length, sample.velocities._length);
    EXPECT_LE((sample.positions._length + sample.velocities._length) * sizeof(float), chunk_bytes - chunk_overhead);
    const std::uint32_t count = sample.positions._length / 3;
    for (std::uint32_t i = 0; i < 3 * count; i += 997) {
      ASSERT_EQ(sample.positions._buffer[i], static_cast<float>(shot.positions[3 * next + i]));
      ASSERT_EQ(sample.velocities._buffer[i], static_cast<float>(shot.velocities[3 * next + i]));
    }
    next += count;
  }
  EXPECT_EQ(next, particles);
}

// What a reader sees of a quantized frame with every field, chunk by chunk.
TEST(FrameMessage, QuantizedChunksShowTheirParticlesOfEveryField) {
  constexpr std::uint32_t particles = 100'001;
  const Shot shot = make_shot(particles, everything_small);
  FrameMessage message("rope");
  message.assign(shot.frame);
  EXPECT_EQ(message.chunks(), 3u);  // 26 bytes a particle
  std::uint32_t next = 0;
  for (std::uint32_t chunk = 0; chunk < message.chunks(); ++chunk) {
    const auto& sample = message.chunk(chunk);
    EXPECT_EQ(sample.first, next);
    EXPECT_EQ(sample.positions._length + sample.positions64._length + sample.velocities64._length, 0u);
    const std::uint32_t count = sample.stretch._length;
    ASSERT_EQ(sample.positions16._length, 3 * count);
    ASSERT_EQ(sample.velocities._length, 3 * count);
    ASSERT_EQ(sample.stress._length, count);
    EXPECT_LE(count * calc_particle_bytes(everything_small), chunk_bytes - chunk_overhead);
    for (std::uint32_t i = 0; i < count; i += 331) {
      const auto particle = static_cast<Eigen::Index>(next + i);
      const double low = sample.bounds[1], extent = sample.bounds[4] - low;
      const double y = low + extent * (sample.positions16._buffer[3 * i + 1] / 65535.0);
      ASSERT_NEAR(y, shot.positions[3 * particle + 1], 0.500001 * extent / 65535.0);
      ASSERT_EQ(sample.velocities._buffer[3 * i], static_cast<float>(shot.velocities[3 * particle]));
      ASSERT_EQ(sample.stretch._buffer[i], static_cast<float>(shot.stretch[particle]));
      ASSERT_EQ(sample.stress._buffer[i], static_cast<float>(shot.stress[particle]));
    }
    next += count;
  }
  EXPECT_EQ(next, particles);
}

TEST(FrameMessage, AQuantizedWorldOfOneParticleIsItsBounds) {
  const Shot shot = make_shot(1, {.precision = StreamPrecision::quantized16});
  FrameMessage message("rope");
  message.assign(shot.frame);
  const auto& sample = message.chunk(0);
  ASSERT_EQ(sample.positions16._length, 3u);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(sample.positions16._buffer[axis], 0u);
    EXPECT_EQ(sample.bounds[axis], shot.positions[axis]);
  }
}

TEST(FrameMessage, AFrameUpToOneMebibyteIsOneSample) {
  const auto fits = static_cast<std::int64_t>((chunk_bytes - chunk_overhead) / 12);
  EXPECT_EQ(calc_frame_size(fits, {}).chunks, 1u);
  EXPECT_EQ(calc_frame_size(fits + 1, {}).chunks, 2u);
}

TEST(Chunks, RunsFollowEachOtherWithoutGapWhateverTheNumbers) {
  for (std::size_t count : {0u, 1u, 7u, 1000u, 99'999u}) {
    for (std::uint32_t chunks : {1u, 2u, 3u, 7u, 100u}) {
      std::size_t next = 0;
      for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
        const ChunkRun run = chunk_run(count, chunk, chunks);
        EXPECT_EQ(run.first, next);
        next += run.count;
      }
      EXPECT_EQ(next, count);
    }
  }
}

}  // namespace
}  // namespace flexcast::server
