// The converged reference is as good as it says, and says when there is none.
#include "core/lab/trade/trade_reference.h"

#include <gtest/gtest.h>

#include "tests/core/lab/trade/trade_case.h"

namespace flexcast::test {
namespace {

class TradeReferenceCase : public TradeCase {};

// Against the exact solution, over a budget that leaves it far above rounding and one that does not.
TEST_F(TradeReferenceCase, KnowsItsOwnErrorWithinAFactorOfTwo) {
  write(linear_scene);
  const auto runner = make_runner(0.1);
  const auto exact = make_exact_reference("linear_modes", runner->runner);
  ASSERT_TRUE(exact) << exact.error().message;
  for (const double share : {0.4, 1.0, 2.0}) {
    const auto converged = make_converged_reference(runner->runner, {share, 1.0, {}});
    ASSERT_TRUE(converged) << converged.error().message;
    const double error = calc_distance(converged.value().frames, exact.value().frames);
    EXPECT_LE(error, 2.0 * converged.value().error) << share;
    EXPECT_GE(error, 0.5 * converged.value().error) << share;
    ASSERT_TRUE(converged.value().order);
    EXPECT_NEAR(*converged.value().order, 4.0, 0.2);
    EXPECT_NE(converged.value().label.find("time.integrator=rk4"), std::string::npos);
  }
}

TEST_F(TradeReferenceCase, HalvesUntilItsErrorIsSmallAgainstTheScene) {
  write(oscillator_scene);
  const auto runner = make_runner(0.5);
  const auto reference = make_converged_reference(runner->runner, {1e6, 1.0, {}});
  ASSERT_TRUE(reference) << reference.error().message;
  EXPECT_LE(reference.value().error, 1e-5);
  ASSERT_GE(reference.value().levels.size(), 3u);
  for (std::size_t i = 1; i < reference.value().levels.size(); ++i) {
    EXPECT_DOUBLE_EQ(reference.value().levels[i].h, 0.5 * reference.value().levels[i - 1].h);
    EXPECT_TRUE(reference.value().levels[i].difference);
  }
}

TEST_F(TradeReferenceCase, KeepsItsShareOfSteps) {
  write(linear_scene);
  const auto runner = make_runner(0.1);
  const std::int64_t before = clock_.steps();
  ASSERT_TRUE(make_converged_reference(runner->runner, {0.5, 1.0, {}}).ok());
  EXPECT_LE(clock_.steps() - before, 500);
}

TEST_F(TradeReferenceCase, ThatFitsNoTwoRunsSaysWhatItWouldTake) {
  write(linear_scene);
  const auto runner = make_runner(0.1);
  const auto reference = make_converged_reference(runner->runner, {0.05, 1.0, {}});
  ASSERT_FALSE(reference);
  EXPECT_TRUE(reference.error().message.starts_with("nothing fits into the budget")) << reference.error().message;
  EXPECT_LE(clock_.steps(), 60);
}

TEST_F(TradeReferenceCase, WithContactsIsImplicit) {
  write(oscillator_scene + "[[contact]]\nname = \"ball\"\nshape = \"sphere\"\ncenter = [9, 0, 0]\nradius = 1.0\n");
  const auto runner = make_runner(0.2);
  const auto reference = make_converged_reference(runner->runner, {5.0, 1.0, {}});
  ASSERT_TRUE(reference) << reference.error().message;
  EXPECT_NE(reference.value().label.find("time.integrator=bdf2"), std::string::npos);
}

TEST(TradeAgreement, EndsWhereTwoMotionsPart) {
  const TradeTimes times{0.5, {1, 2, 4}};
  const auto at = [](double x) { return TradeFrame{VecX::Constant(3, x), VecX()}; };
  const TradeFrames still{at(0.0), {at(0.0), at(0.0), at(0.0)}}, parting{at(0.0), {at(1e-3), at(0.1), at(1e-3)}};
  EXPECT_DOUBLE_EQ(calc_agreed_until(still, still, times, 0.01), 2.0);
  EXPECT_DOUBLE_EQ(calc_agreed_until(still, parting, times, 0.01), 0.5);
  EXPECT_DOUBLE_EQ(calc_agreed_until(still, parting, times, 1e-4), 0.0);
}

TEST(TradeOwnError, TrustsNoOrderButTheOneObserved) {
  EXPECT_DOUBLE_EQ(calc_own_error(0.1, std::nullopt, 4), 0.1);  // first order, to be careful
  EXPECT_DOUBLE_EQ(calc_own_error(0.1, 0.4, 4), 0.1 / 3.0);     // 2 observed
  EXPECT_DOUBLE_EQ(calc_own_error(0.1, 100.0, 2), 0.1 / 3.0);   // better than theory: by theory
  EXPECT_GT(calc_own_error(0.1, 0.1, 2), 0.2);                  // no order: more than the difference
  EXPECT_EQ(calc_own_error(0.0, 0.1, 2), 0.0);
}

}  // namespace
}  // namespace flexcast::test
