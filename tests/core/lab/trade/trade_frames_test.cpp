// Distances between motions, the times they are taken at, volumes.
#include "core/lab/trade/trade_frames.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/lab/trade/trade_times.h"
#include "core/lab/trade/trade_volume.h"
#include "tests/core/lab/trade/trade_case.h"
#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

TradeFrame make_frame(double x, double volume) {
  TradeFrame frame{VecX::Zero(12), VecX::Constant(1, volume)};
  frame.positions[4] = x;  // y of particle 1 of four
  return frame;
}

TEST(TradeErrors, AgainstItselfAreZero) {
  TradeErrors errors;
  add_frame(make_frame(0.3, 2.0), make_frame(0.3, 2.0), {0, 1}, errors);
  for (const double value : {errors.rms, errors.rms_end, errors.largest, errors.largest_end, errors.volume,
                             errors.probes[0], errors.probes[1], errors.probes_end[1]})
    EXPECT_EQ(value, 0.0);
}

TEST(TradeErrors, AreTheLastAndTheLargestOverTheTimes) {
  TradeErrors errors;
  add_frame(make_frame(0.4, 1.5), make_frame(0.0, 2.0), {1, 3}, errors);
  add_frame(make_frame(-0.2, 2.0), make_frame(0.0, 2.0), {1, 3}, errors);
  EXPECT_DOUBLE_EQ(errors.rms, 0.2);  // 0.4 m of one particle among four
  EXPECT_DOUBLE_EQ(errors.rms_end, 0.1);
  EXPECT_DOUBLE_EQ(errors.largest, 0.4);
  EXPECT_DOUBLE_EQ(errors.largest_end, 0.2);
  EXPECT_EQ(errors.probes, (std::vector<double>{0.4, 0.0}));
  EXPECT_EQ(errors.probes_end, (std::vector<double>{0.2, 0.0}));
  EXPECT_DOUBLE_EQ(errors.volume, 0.25);
}

TEST(TradeFrames, MotionIsTheLargestDisplacementFromTheStart) {
  const TradeFrames frames{make_frame(0.1, 0.0), {make_frame(0.5, 0.0), make_frame(0.2, 0.0)}};
  EXPECT_DOUBLE_EQ(calc_motion(frames), 0.2);
  EXPECT_DOUBLE_EQ(calc_distance(frames, frames), 0.0);
}

TEST(TradeTimes, AreEveryFrameOrUpToSomeEvenlySpacedAndTheEnd) {
  const auto all = make_trade_times(0.1, 1.0, 1);
  ASSERT_TRUE(all);
  EXPECT_EQ(all.value().compared, (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_DOUBLE_EQ(all.value().duration(), 1.0);
  const auto some = make_trade_times(0.1, 1.0, 1, 4);
  EXPECT_EQ(some.value().compared, (std::vector<std::int64_t>{3, 6, 9, 10}));
}

TEST(TradeTimes, AreThoseThatLongStepsHaveInCommon) {
  const auto times = make_trade_times(0.1, 2.0, 6);
  ASSERT_TRUE(times);
  EXPECT_EQ(times.value().compared, (std::vector<std::int64_t>{6, 12, 18}));
}

TEST(TradeTimes, ThatAreNoneOrTooManyAreRefused) {
  EXPECT_NE(make_trade_times(0.1, 0.2, 6).error().message.find("multiples of 0.6 s"), std::string::npos);
  EXPECT_NE(make_trade_times(1e-9, 1e9, 1).error().message.find("too long"), std::string::npos);
}

// Half a block's mesh is stretched: the same motion of linear and quadratic elements has the same volume.
TEST(TradeVolume, IsThatOfTheMappedElements) {
  for (const char* element : {"tet4", "tet10"}) {
    const Scene scene = loaded(linear_scene, {std::string("block.element=") + element});
    const Model& model = scene.simulation->model();
    EXPECT_NEAR(calc_volumes(model, model.rest_positions)[0], 0.25, 1e-14) << element;
    VecX stretched = model.rest_positions;
    for (std::int64_t i = 0; i < model.particle_count(); ++i) stretched[3 * i] *= 3.0;
    EXPECT_NEAR(calc_volumes(model, stretched)[0], 0.75, 1e-14) << element;
  }
}

// x -> x + x^2 / 2 has the determinant 1 + x, whose integral over the block (1 m x 0.5 m x 0.5 m) is 0.375 m^3. The
// quadratic map is exact in tet10.
TEST(TradeVolume, OfQuadraticElementsCountsTheirCurvature) {
  const Scene scene = loaded(linear_scene, {"block.element=tet10"});
  const Model& model = scene.simulation->model();
  VecX bent = model.rest_positions;
  for (std::int64_t i = 0; i < model.particle_count(); ++i) bent[3 * i] += 0.5 * bent[3 * i] * bent[3 * i];
  EXPECT_NEAR(calc_volumes(model, bent)[0], 0.375, 1e-14);
}

}  // namespace
}  // namespace flexcast::test
