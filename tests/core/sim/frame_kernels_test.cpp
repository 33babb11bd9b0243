// The loops over a frame's numbers, against the plain ones, on every instruction set of this machine.
#include "core/sim/frame_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/instruction_set.h"

namespace flexcast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> make_numbers(std::size_t count) {
  std::mt19937 random(static_cast<unsigned>(count));
  std::uniform_real_distribution<double> uniform(-10.0, 10.0);
  std::vector<double> numbers(count);
  for (double& number : numbers) number = uniform(random);
  return numbers;
}

using Box = std::array<double, 6>;

Box calc_box(const std::vector<double>& positions) {
  Box box = {infinity, infinity, infinity, -infinity, -infinity, -infinity};
  widen_bounds(positions.data(), std::ssize(positions), &box[0], &box[3]);
  return box;
}

Box calc_plain_box(const std::vector<double>& positions) {
  Box box = {infinity, infinity, infinity, -infinity, -infinity, -infinity};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    box[i % 3] = std::min(box[i % 3], positions[i]);
    box[i % 3 + 3] = std::max(box[i % 3 + 3], positions[i]);
  }
  return box;
}

std::vector<test::InstructionSet> instruction_sets() {
  auto sets = test::fused_instruction_sets();
  sets.push_back({"plain", test::plain_instruction_set()});
  return sets;
}

class FrameKernels : public testing::TestWithParam<test::InstructionSet> {
 protected:
  const test::OnlyInstructionSet only_{GetParam().target};
};

TEST_P(FrameKernels, FloatsAreTheDoublesRoundedForEveryCount) {
  for (std::size_t count = 0; count < 70; ++count) {
    std::vector<double> numbers = make_numbers(count);
    if (count > 20) numbers[3] = 1e300, numbers[4] = 1e-45, numbers[5] = -0.0, numbers[20] = 16777217.0;
    std::vector<float> floats(count + 1, 7.0f);
    convert_to_floats(numbers.data(), std::ssize(numbers), floats.data());
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(floats[i], static_cast<float>(numbers[i])) << i << " of " << count;
      ASSERT_EQ(std::signbit(floats[i]), std::signbit(numbers[i])) << i << " of " << count;
    }
    EXPECT_EQ(floats[count], 7.0f) << "what follows is not touched";
  }
}

TEST_P(FrameKernels, TheBoxIsThatOfThePlainLoopForEveryCount) {
  for (std::size_t particles = 1; particles < 60; ++particles) {
    const auto positions = make_numbers(3 * particles);
    EXPECT_EQ(calc_box(positions), calc_plain_box(positions)) << particles;
  }
}

TEST_P(FrameKernels, EveryPlaceOfThePositionsCanBeTheCornerOfTheBox) {
  auto positions = make_numbers(3 * 50);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double before = positions[i];
    for (const double corner : {-20.0, 20.0}) {
      positions[i] = corner;
      EXPECT_EQ(calc_box(positions), calc_plain_box(positions)) << i;
    }
    positions[i] = before;
  }
}

TEST_P(FrameKernels, ABoxIsOnlyWidened) {
  Box box = {-50, 0, -50, 50, 0, 50};
  const auto positions = make_numbers(300);
  widen_bounds(positions.data(), std::ssize(positions), &box[0], &box[3]);
  const Box own = calc_plain_box(positions);
  EXPECT_EQ(box, (Box{-50, own[1], -50, 50, own[4], 50}));
}

TEST_P(FrameKernels, AZeroBoundIsPositiveWhicheverZeroCameFirst) {
  std::vector<double> positions(3 * 40, 0.0);
  for (std::size_t i = 0; i < positions.size(); i += 2) positions[i] = -0.0;
  for (const double bound : calc_box(positions)) EXPECT_FALSE(std::signbit(bound));
}

TEST_P(FrameKernels, FractionsAreThoseOfThePlainLoopForEveryCount) {
  for (std::size_t particles = 1; particles < 40; ++particles) {
    auto positions = make_numbers(3 * particles);
    for (std::size_t i = 2; i < positions.size(); i += 3) positions[i] = 0.25;  // a flat box
    const Box box = calc_box(positions);
    std::vector<std::uint16_t> fractions(positions.size() + 1, 7);
    quantize(positions.data(), std::ssize(positions), &box[0], &box[3], fractions.data());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double low = box[i % 3], extent = box[i % 3 + 3] - low;
      const double fraction = extent > 0.0 ? (positions[i] - low) / extent : 0.0;
      ASSERT_EQ(fractions[i], static_cast<std::uint16_t>(fraction * 65535.0 + 0.5)) << i << " of " << particles;
    }
    EXPECT_EQ(fractions.back(), 7) << "what follows is not touched";
  }
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, FrameKernels, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return set.param.name; });

}  // namespace
}  // namespace flexcast
