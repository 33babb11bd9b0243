#include "clients/web/frame_grouper.h"

#include <gtest/gtest.h>

#include "tests/clients/web/web.h"

namespace flexcast::web {
namespace {

wire::FrameHead head(std::uint64_t run, std::uint64_t frame, std::uint32_t chunk, std::uint32_t chunks) {
  wire::FrameHead result;
  result.run_id = run;
  result.frame = frame;
  result.chunk = chunk;
  result.chunks = chunks;
  return result;
}

TEST(FrameGrouper, AFrameIsWholeWithItsLastChunkInWhateverOrder) {
  FrameGrouper grouper;
  EXPECT_FALSE(grouper.add(head(1, 0, 2, 3), make_sample("c")));
  EXPECT_FALSE(grouper.add(head(1, 0, 0, 3), make_sample("a")));
  const auto frame = grouper.add(head(1, 0, 1, 3), make_sample("b"));
  ASSERT_TRUE(frame);
  std::string text;
  for (const Sample& chunk : frame->chunks) text += text_of(chunk.bytes);
  EXPECT_EQ(text, "abc");
}

TEST(FrameGrouper, AFrameThatMissesAChunkIsLeftOutAndOlderOnesDoNotFollowNewer) {
  FrameGrouper grouper;
  EXPECT_FALSE(grouper.add(head(1, 4, 0, 2), make_sample("x")));
  EXPECT_FALSE(grouper.add(head(1, 5, 0, 2), make_sample("a")));
  EXPECT_TRUE(grouper.add(head(1, 5, 1, 2), make_sample("b")));
  EXPECT_FALSE(grouper.add(head(1, 4, 1, 2), make_sample("y")));
  EXPECT_FALSE(grouper.add(head(1, 5, 0, 1), make_sample("z")));
  EXPECT_TRUE(grouper.add(head(2, 0, 0, 1), make_sample("new run")));
}

TEST(FrameGrouper, ContradictionsAndRepeatsAreIgnored) {
  FrameGrouper grouper;
  EXPECT_FALSE(grouper.add(head(1, 0, 2, 2), make_sample("x")));
  EXPECT_FALSE(grouper.add(head(1, 0, 0, ~0u), make_sample("x")));
  EXPECT_FALSE(grouper.add(head(1, 0, 0, 2), make_sample("a")));
  EXPECT_FALSE(grouper.add(head(1, 0, 0, 2), make_sample("a")));
  EXPECT_FALSE(grouper.add(head(1, 0, 1, 3), make_sample("b")));
  EXPECT_TRUE(grouper.add(head(1, 0, 1, 2), make_sample("b")));
}

TEST(FrameGrouper, FewBegunFramesAreKept) {
  FrameGrouper grouper;
  for (std::uint64_t frame = 0; frame <= FrameGrouper::most_partials; ++frame)
    EXPECT_FALSE(grouper.add(head(1, frame, 0, 2), make_sample("a")));
  EXPECT_FALSE(grouper.add(head(1, 0, 1, 2), make_sample("b")));  // the oldest has gone
  EXPECT_TRUE(grouper.add(head(1, FrameGrouper::most_partials, 1, 2), make_sample("b")));
}

}  // namespace
}  // namespace flexcast::web
