#include "clients/client/frame.h"

#include <gtest/gtest.h>

#include <array>

#include "idl/wire/fill.h"
#include "idl/wire/owned.h"

namespace flexcast::client {
namespace {

using Sample = wire::Owned<flexcast_ParticleFrame>;

// Chunk of one particle whose x is 10 * frame + chunk.
Sample chunk_of(std::uint64_t run, std::uint64_t frame, std::uint32_t chunk, std::uint32_t chunks) {
  Sample sample;
  sample->run_id = run;
  sample->frame = frame;
  sample->chunk = sample->first = chunk;
  sample->chunks = sample->total = chunks;
  const auto x = static_cast<float>(10 * frame + chunk);
  wire::copy(sample->positions, std::array{x, 0.0f, 0.5f});
  return sample;
}

TEST(FrameAssembler, ReturnsFramesOfOneChunkAtOnce) {
  FrameAssembler assembler;
  const auto frame = assembler.add(*chunk_of(1, 0, 0, 1));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->positions, (std::vector{0.0, 0.0, 0.5}));
  EXPECT_TRUE(frame->velocities.empty());
}

TEST(FrameAssembler, PutsChunksTogetherInAnyOrder) {
  FrameAssembler assembler;
  EXPECT_FALSE(assembler.add(*chunk_of(1, 3, 2, 3)));
  EXPECT_FALSE(assembler.add(*chunk_of(1, 3, 0, 3)));
  EXPECT_FALSE(assembler.add(*chunk_of(1, 3, 0, 3))) << "the same chunk again";
  const auto frame = assembler.add(*chunk_of(1, 3, 1, 3));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->position(0)[0], 30);
  EXPECT_EQ(frame->position(1)[0], 31);
  EXPECT_EQ(frame->position(2)[0], 32);
}

// A reader hands samples over instance by instance: all first chunks, then all second ones.
TEST(FrameAssembler, LosesNothingWhenChunksComeInstanceByInstance) {
  FrameAssembler assembler;
  for (std::uint64_t frame = 0; frame < 10; ++frame) EXPECT_FALSE(assembler.add(*chunk_of(1, frame, 0, 2)));
  for (std::uint64_t frame = 0; frame < 10; ++frame) {
    const auto whole = assembler.add(*chunk_of(1, frame, 1, 2));
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->frame, frame);
  }
  EXPECT_EQ(assembler.missed(), 0u);
}

TEST(FrameAssembler, IgnoresNumbersThatAreNotNewerWithinARun) {
  FrameAssembler assembler;
  EXPECT_TRUE(assembler.add(*chunk_of(1, 5, 0, 1)));
  EXPECT_FALSE(assembler.add(*chunk_of(1, 5, 0, 1)));
  EXPECT_FALSE(assembler.add(*chunk_of(1, 4, 0, 1)));
  EXPECT_TRUE(assembler.add(*chunk_of(2, 0, 0, 1))) << "a new run starts at 0";
}

TEST(FrameAssembler, CountsMissingNumbersOfTheRun) {
  FrameAssembler assembler;
  EXPECT_TRUE(assembler.add(*chunk_of(1, 7, 0, 1)));
  EXPECT_EQ(assembler.missed(), 0u) << "what was before the first is not missing";
  EXPECT_TRUE(assembler.add(*chunk_of(1, 10, 0, 1)));
  EXPECT_EQ(assembler.missed(), 2u);
  EXPECT_TRUE(assembler.add(*chunk_of(2, 0, 0, 1)));
  EXPECT_EQ(assembler.missed(), 0u);
}

TEST(FrameAssembler, DecodesEveryPrecision) {
  FrameAssembler assembler;
  Sample wide = chunk_of(1, 0, 0, 1);
  wire::copy(wide->positions, {});
  wire::copy(wide->positions64, std::array{0.1, 0.2, 0.3});
  wire::copy(wide->velocities64, std::array{1.0, 2.0, 3.0});
  wire::copy(wide->stretch, std::array{1.5f});
  wire::copy(wide->stress, std::array{250.0f});
  const auto whole = assembler.add(*wide);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->positions, (std::vector{0.1, 0.2, 0.3}));
  EXPECT_EQ(whole->velocities, (std::vector{1.0, 2.0, 3.0}));
  EXPECT_EQ(whole->stretch, (std::vector{1.5}));
  EXPECT_EQ(whole->stress, (std::vector{250.0}));

  Sample narrow = chunk_of(1, 1, 0, 1);
  const double bounds[6] = {-1, 0, 2, 1, 0, 4};
  std::copy(std::begin(bounds), std::end(bounds), narrow->bounds);
  wire::copy(narrow->positions, {});
  wire::copy(narrow->positions16, std::array<std::uint16_t, 3>{65535, 0, 13107});
  EXPECT_EQ(assembler.add(*narrow)->positions, (std::vector{1.0, 0.0, 2.4}));
}

TEST(FrameAssembler, IgnoresSamplesThatContradictThemselves) {
  FrameAssembler assembler;
  EXPECT_FALSE(assembler.add(*chunk_of(1, 0, 1, 1))) << "chunk 1 of 1";
  Sample outside = chunk_of(1, 1, 0, 1);
  outside->first = 1;
  EXPECT_FALSE(assembler.add(*outside));
  EXPECT_TRUE(assembler.add(*chunk_of(1, 2, 0, 1)));
}

}  // namespace
}  // namespace flexcast::client
