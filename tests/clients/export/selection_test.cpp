#include "clients/export/selection.h"

#include <gtest/gtest.h>

#include "tests/support/recording_maker.h"

namespace flexcast::exporting {
namespace {

// Run 100 of ten frames, run 200 with the frames 0 to 4, 6, 9.
class SelectionTest : public testing::Test {
 protected:
  SelectionTest() {
    flexcast::test::RecordingMaker maker(folder_.path("run.mcap"));
    maker.add_run(100, 10);
    maker.add_run(200, 5);
    maker.add_frame(200, 6);
    maker.add_frame(200, 9);
    maker.close();
    auto recording = recording::Recording::open(folder_.path("run.mcap")).value();
    index_ = recording::Index::make(recording, {}).value();
  }

  std::vector<std::uint64_t> numbers(const Selection& selection) const {
    std::vector<std::uint64_t> numbers;
    for (const std::size_t i : selection.frames) numbers.push_back(index_.frames()[i].number);
    return numbers;
  }

  const flexcast::test::TemporaryFolder folder_;
  recording::Index index_;
};

using Numbers = std::vector<std::uint64_t>;

TEST_F(SelectionTest, IsTheLastRunWithItsGapsUnlessAnotherIsNamed) {
  const Selection last = select(index_, {.file = "run.mcap"}).value();
  EXPECT_EQ(last.run_id, 200U);
  EXPECT_EQ(numbers(last), (Numbers{0, 1, 2, 3, 4, 6, 9}));
  ASSERT_EQ(last.missing.size(), 2U);
  EXPECT_EQ(last.missing[0].first, 5U);
  EXPECT_EQ(last.missing[0].last, 5U);
  EXPECT_EQ(last.missing[1].first, 7U);
  EXPECT_EQ(last.missing[1].last, 8U);
  const Selection first = select(index_, {.file = "run.mcap", .run = 1}).value();
  EXPECT_EQ(first.run_id, 100U);
  EXPECT_TRUE(first.missing.empty());
}

TEST_F(SelectionTest, BoundsIncludeTheFramesAtThemAndEveryNthIsTaken) {
  EXPECT_EQ(numbers(select(index_, {.run = 1, .from = 0.3, .to = 0.6}).value()), (Numbers{3, 4, 5, 6}));
  EXPECT_EQ(numbers(select(index_, {.run = 1, .from = 0.1, .every = 3}).value()), (Numbers{1, 4, 7}));
  EXPECT_TRUE(select(index_, {.run = 1, .every = 3}).value().missing.empty());
  EXPECT_TRUE(select(index_, {.to = 0.4}).value().missing.empty());
}

TEST_F(SelectionTest, WhatIsNotThereIsAnErrorThatSaysWhatIs) {
  const auto run = select(index_, {.file = "run.mcap", .run = 3});
  ASSERT_FALSE(run.ok());
  EXPECT_EQ(run.error().message, "run.mcap: there is no run 3; --run takes 1 to 2");
  const auto time = select(index_, {.file = "run.mcap", .from = 5.0});
  ASSERT_FALSE(time.ok());
  EXPECT_EQ(time.error().message, "run.mcap: run 2 (id 200: 7 frames, 0 s to 0.9 s) has no frame at these times");
}

TEST_F(SelectionTest, TheOtherRunsAreNamed) {
  EXPECT_EQ(describe_run(index_, 1),
            "run 2 (id 200: 7 frames, 0 s to 0.9 s) of 2; the others: run 1 (id 100: 10 frames, 0 s to 0.9 s)");
}

}  // namespace
}  // namespace flexcast::exporting
