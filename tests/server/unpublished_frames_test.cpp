#include "server/unpublished_frames.h"

#include <gtest/gtest.h>

#include <utility>

namespace flexcast::server {
namespace {

using Ranges = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

Ranges ranges_of(const UnpublishedFrames& frames) {
  Ranges ranges;
  for (const FrameRange& range : frames.ranges()) ranges.emplace_back(range.first, range.last);
  return ranges;
}

TEST(UnpublishedFrames, ArePublishedFramesNot) {
  UnpublishedFrames frames;
  for (std::uint64_t i = 0; i < 10; ++i) frames.note(i, true);
  EXPECT_EQ(ranges_of(frames), Ranges());
}

TEST(UnpublishedFrames, AreThoseThatNobodyReadAndThoseThatNeverCame) {
  UnpublishedFrames frames;
  frames.note(0, false);
  frames.note(1, false);
  frames.note(2, true);
  frames.note(5, true);   // 3 and 4 found no room
  frames.note(8, false);  // nor did 6 and 7
  EXPECT_EQ(ranges_of(frames), (Ranges{{0, 1}, {3, 4}, {6, 8}}));
}

TEST(UnpublishedFrames, TheFirstOfARunMayHaveFoundNoRoom) {
  UnpublishedFrames frames;
  frames.note(3, true);
  EXPECT_EQ(ranges_of(frames), (Ranges{{0, 2}}));
}

TEST(UnpublishedFrames, TheNewestLeavesItsRangeWhenItIsPublishedLate) {
  UnpublishedFrames frames;
  frames.note(0, false);
  frames.note(1, false);
  frames.note_newest_published();
  EXPECT_EQ(ranges_of(frames), (Ranges{{0, 0}}));
  frames.note(3, false);
  frames.note_newest_published();
  EXPECT_EQ(ranges_of(frames), (Ranges{{0, 0}, {2, 2}}));
  frames.note(4, true);
  frames.note_newest_published();  // it was not missing
  frames.note(5, true);
  EXPECT_EQ(ranges_of(frames), (Ranges{{0, 0}, {2, 2}}));
}

TEST(UnpublishedFrames, ARangeOfOneGoesWhenItsFrameIsPublishedLate) {
  UnpublishedFrames frames;
  frames.note(0, false);
  frames.note_newest_published();
  frames.note(1, true);
  EXPECT_EQ(ranges_of(frames), Ranges());
}

TEST(UnpublishedFrames, TheNewestRangesAreKept) {
  UnpublishedFrames frames;
  for (std::uint64_t i = 1; i < 200; i += 2) frames.note(i, true);  // 0, 2, 4, ... are missing
  const Ranges ranges = ranges_of(frames);
  ASSERT_EQ(ranges.size(), UnpublishedFrames::most_ranges);
  EXPECT_EQ(ranges.back(), (Ranges::value_type{198, 198}));
  EXPECT_EQ(ranges.front(), (Ranges::value_type{72, 72}));
}

TEST(UnpublishedFrames, AnotherRunBeginsAnew) {
  UnpublishedFrames frames;
  frames.note(7, false);
  frames.clear();
  frames.note(0, true);
  frames.note(1, false);
  EXPECT_EQ(ranges_of(frames), (Ranges{{1, 1}}));
}

}  // namespace
}  // namespace flexcast::server
