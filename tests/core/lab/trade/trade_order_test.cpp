// Observed orders are those of the data, and those of the data of our schemes are those of theory.
#include "core/lab/trade/trade_order.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/lab/trade/trade_case.h"

namespace flexcast::test {
namespace {

using Points = std::vector<std::array<double, 2>>;

// C h^p at halved steps, from the coarsest on.
Points make_points(double order, int count) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back({std::exp2(-i), 0.1 * std::exp2(-i * order)});
  return points;
}

TEST(TradeOrder, IsTheSlopeOfAPowerLaw) {
  for (const double order : {1.0, 2.0, 4.0}) {
    const auto observed = calc_order(make_points(order, 5));
    ASSERT_TRUE(observed);
    EXPECT_NEAR(observed->order, order, 1e-12);
    EXPECT_EQ(observed->settings, 5);
  }
}

TEST(TradeOrder, LeavesOutWhatIsNotYetOrNoLongerAsymptotic) {
  Points points = make_points(2.0, 6);
  points[0][1] = 0.11;                 // too coarse
  points[5][1] = 0.99 * points[4][1];  // something else is larger than the error of the step
  const auto observed = calc_order(points);
  ASSERT_TRUE(observed);
  EXPECT_NEAR(observed->order, 2.0, 0.1);
  EXPECT_LE(observed->settings, 5);
}

TEST(TradeOrder, IsThatOfTheFinestSettingsNotOfTheMost) {
  Points points;
  for (int i = 0; i < 5; ++i) points.push_back({std::exp2(-i), std::exp2(-i)});  // first order while coarse
  for (int i = 5; i < 8; ++i) points.push_back({std::exp2(-i), std::exp2(-4 - 2 * (i - 4))});  // then second
  const auto observed = calc_order(points);
  ASSERT_TRUE(observed);
  EXPECT_NEAR(observed->order, 2.0, 1e-12);
  EXPECT_EQ(observed->settings, 4);
}

TEST(TradeOrder, NeedsThreeSettingsThatAgree) {
  EXPECT_FALSE(calc_order(Points{}));
  EXPECT_FALSE(calc_order(make_points(2.0, 2)));
  EXPECT_FALSE(calc_order(Points{{1.0, 0.1}, {0.5, 0.05}, {0.25, 0.0125}}));
  EXPECT_FALSE(calc_order(Points{{1.0, 0.1}, {0.5, 0.1}, {0.25, 0.1}}));
}

TEST(TradeOrder, DoesNotCountWhatFailedIsInaccurateOrAtTheReferencesLimit) {
  std::vector<TradeResult> results(5);
  for (std::size_t i = 0; i < results.size(); ++i) {
    results[i].status = TradeResult::Status::done;
    results[i].h = std::exp2(-static_cast<double>(i));
    results[i].error = 0.1 * results[i].h;
  }
  EXPECT_EQ(calc_order(results, 0)->settings, 5);
  results[0].error = 0.5;
  EXPECT_EQ(calc_order(results, 0)->settings, 4);
  results[4].at_limit = true;
  EXPECT_EQ(calc_order(results, 0)->settings, 3);
  results[1].status = TradeResult::Status::failed;
  EXPECT_FALSE(calc_order(results, 0));
  EXPECT_FALSE(calc_order(results, 1));
}

struct SchemeOrder {
  const char* integrator;
  double order;
  std::vector<double> steps;
};

class TradeSchemes : public TradeCase, public testing::WithParamInterface<SchemeOrder> {};

// The fastest mode of the block has omega = 60 1/s or so: steps are chosen so that omega h is small, and the errors far
// above rounding. The end (a fraction of a slow period) is short, so that the growth of forward Euler, exp(omega^2 h T
// / 2), stays near 1. The block starts with gravity unbalanced: the first-order error of symplectic Euler, a start half
// a step late, is proportional to the first acceleration and would vanish without. The norm is the largest over the
// times, which no passage through zero at one time can fool.
TEST_P(TradeSchemes, AreObservedWithinATenthOfTheirTheory) {
  write(linear_scene);
  options_.integrators = {GetParam().integrator};
  options_.steps = GetParam().steps;
  options_.until = 0.1;
  options_.repeats = 1;
  const Trade trade = measure();
  ASSERT_EQ(trade.orders.size(), 1u);
  ASSERT_TRUE(trade.orders[0]);
  EXPECT_NEAR(trade.orders[0]->order, GetParam().order, 0.1);
  EXPECT_GE(trade.orders[0]->settings, 3);
  EXPECT_EQ(find_integrator(GetParam().integrator)->order, GetParam().order);
}

const std::vector<double> coarse = {1e-3, 5e-4, 2.5e-4}, fine = {2e-4, 1e-4, 5e-5};
INSTANTIATE_TEST_SUITE_P(All, TradeSchemes,
                         testing::Values(SchemeOrder{"forward_euler", 1, fine},
                                         SchemeOrder{"symplectic_euler", 1, fine},
                                         SchemeOrder{"velocity_verlet", 2, coarse}, SchemeOrder{"rk4", 4, coarse},
                                         SchemeOrder{"backward_euler", 1, fine},
                                         SchemeOrder{"implicit_midpoint", 2, coarse}, SchemeOrder{"bdf2", 2, coarse}),
                         [](const auto& row) { return std::string(row.param.integrator); });

}  // namespace
}  // namespace flexcast::test
