#include "clients/replay/clips.h"

#include <gtest/gtest.h>

#include "tests/support/recording_maker.h"

namespace flexcast::replay {
namespace {

class Clips : public testing::Test {
 protected:
  // Run 100 from 0 s to 0.9 s, run 200 from 0 s to 0.3 s.
  Clips() {
    flexcast::test::RecordingMaker maker(folder_.path("run.mcap"));
    maker.add_run(100, 10);
    maker.add_run(200, 4);
    maker.close();
    auto recording = recording::Recording::open(folder_.path("run.mcap")).value();
    index_ = recording::Index::make(recording, {}).value();
  }

  const flexcast::test::TemporaryFolder folder_;
  recording::Index index_;
};

TEST_F(Clips, WithoutBoundsAreTheRuns) {
  const auto clips = make_clips(index_, {}, {});
  ASSERT_EQ(clips.size(), 2U);
  EXPECT_TRUE(clips[0].from_start && clips[0].to_end && clips[1].from_start && clips[1].to_end);
  EXPECT_EQ(clips[0].begin, 0U);
  EXPECT_EQ(clips[0].end, 10U);
  EXPECT_EQ(clips[1].run_id, 200U);
  EXPECT_EQ(clips[1].end, 14U);
}

TEST_F(Clips, BoundsAreOfEachRunAndIncludeTheFramesAtThem) {
  const auto clips = make_clips(index_, 0.3, 0.6);  // 3 x 0.1 and 6 x 0.1 are a little more than these
  ASSERT_EQ(clips.size(), 2U);
  EXPECT_EQ(clips[0].begin, 3U);
  EXPECT_EQ(clips[0].end, 7U);
  EXPECT_FALSE(clips[0].from_start || clips[0].to_end || clips[1].from_start);
  EXPECT_EQ(clips[1].begin, 13U);
  EXPECT_TRUE(clips[1].to_end);
}

TEST_F(Clips, ARunThatDoesNotReachThereIsLeftOut) {
  const auto clips = make_clips(index_, 0.5, {});
  ASSERT_EQ(clips.size(), 1U);
  EXPECT_EQ(clips[0].run_id, 100U);
  EXPECT_TRUE(make_clips(index_, 2.0, {}).empty());
}

}  // namespace
}  // namespace flexcast::replay
