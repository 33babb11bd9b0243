#include "clients/record/frame_ranges.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace flexcast::record {
namespace {

constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();

TEST(FrameRanges, AgreesWithASetOfNumbersInWhateverOrderTheyCome) {
  std::mt19937_64 random(7);
  FrameRanges ranges;
  std::set<std::uint64_t> numbers;
  for (int i = 0; i < 400; ++i) {
    const std::uint64_t frame = random() % 500;
    ranges.add(frame);
    numbers.insert(frame);
    ASSERT_EQ(ranges.size(), numbers.size());
    ASSERT_EQ(ranges.first(), *numbers.begin());
    ASSERT_EQ(ranges.last(), *numbers.rbegin());
  }
  for (std::uint64_t frame = 0; frame < 500; ++frame) {
    const auto stretch = ranges.stretch(frame);
    ASSERT_EQ(stretch.contained, numbers.contains(frame)) << frame;
    ASSERT_GE(stretch.last, frame);
    for (std::uint64_t other = frame; other <= std::min<std::uint64_t>(stretch.last, 500); ++other) {
      ASSERT_EQ(numbers.contains(other), stretch.contained) << frame << ' ' << other;
    }
    if (stretch.last < 500) {
      ASSERT_NE(numbers.contains(stretch.last + 1), stretch.contained) << frame;
    }
  }
}

TEST(FrameRanges, AgreesWithASetWhenRangesAreAddedAndNumbersRemoved) {
  std::mt19937_64 random(9);
  FrameRanges ranges;
  std::set<std::uint64_t> numbers;
  for (int i = 0; i < 600; ++i) {
    const std::uint64_t first = random() % 300, last = first + random() % 6;
    if (i % 3 == 0) {
      ranges.add(FrameRange{first, last});
      for (std::uint64_t number = first; number <= last; ++number) numbers.insert(number);
    } else {
      ranges.remove(first);
      numbers.erase(first);
    }
    ASSERT_EQ(ranges.size(), numbers.size());
    for (std::uint64_t number = 0; number < 310; ++number) {
      ASSERT_EQ(ranges.contains(number), numbers.contains(number)) << number;
    }
    const std::vector<FrameRange> list = ranges.ranges();
    for (std::size_t k = 0; k + 1 < list.size(); ++k) ASSERT_LT(list[k].last + 1, list[k + 1].first);
  }
}

TEST(FrameRanges, HoldsBothEndsOfTheNumbers) {
  FrameRanges ranges;
  EXPECT_TRUE(ranges.empty());
  EXPECT_EQ(ranges.stretch(0).last, largest);
  ranges.add(largest);
  ranges.add(0);
  ranges.add(largest - 1);
  EXPECT_EQ(ranges.size(), 3u);
  EXPECT_TRUE(ranges.contains(0));
  EXPECT_TRUE(ranges.contains(largest));
  EXPECT_EQ(ranges.stretch(1).last, largest - 2);
  EXPECT_EQ(ranges.stretch(largest - 1).last, largest);
}

}  // namespace
}  // namespace flexcast::record
