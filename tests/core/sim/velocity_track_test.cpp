// Time derivatives of the velocities from the last few steps, evenly spaced or not.
#include "core/sim/velocity_track.h"

#include <gtest/gtest.h>

namespace flexcast {
namespace {

// Two particles whose velocities are polynomials of the third degree, and opposite.
VecX cubic(double t) {
  const double value = 1.0 + 2.0 * t + 3.0 * t * t + 4.0 * t * t * t;
  VecX velocities(6);
  velocities << value, 0.0, 0.0, -value, 0.0, 0.0;
  return velocities;
}

VelocityTrack make_track(std::initializer_list<double> times, const Vec3& wind = Vec3::Zero()) {
  VelocityTrack track;
  bool first = true;
  for (const double time : times) {
    VecX velocities = cubic(time);
    for (Eigen::Index i = 0; i < 6; ++i) velocities[i] += wind[i % 3];
    if (first) track.begin(time, velocities);
    if (!first) track.observe(time, velocities);
    first = false;
  }
  return track;
}

TEST(VelocityTrack, KnowsACubicsThirdDerivativeWhateverTheSpacing) {
  for (const auto& times : {std::initializer_list<double>{0.0, 0.1, 0.2, 0.3}, {0.0, 0.05, 0.25, 0.3}}) {
    const VelocityDerivatives derivatives = make_track(times).calc_derivatives();
    ASSERT_EQ(derivatives.known, 4);
    EXPECT_NEAR(derivatives.rms[3], 24.0, 1e-9);
  }
}

TEST(VelocityTrack, TakesEachDerivativeFromTheFewestNewestPoints) {
  const VelocityDerivatives derivatives = make_track({0.0, 0.1, 0.2, 0.3}).calc_derivatives();
  EXPECT_NEAR(derivatives.rms[0], cubic(0.3)[0], 1e-12);
  EXPECT_NEAR(derivatives.rms[1], (cubic(0.3)[0] - cubic(0.2)[0]) / 0.1, 1e-10);
  EXPECT_NEAR(derivatives.rms[2], (cubic(0.3)[0] - 2.0 * cubic(0.2)[0] + cubic(0.1)[0]) / 0.01, 1e-9);
}

TEST(VelocityTrack, DoesNotMindAWorldThatFliesPast) {
  const auto still = make_track({0.0, 0.1, 0.2, 0.3}).calc_derivatives();
  const auto flying = make_track({0.0, 0.1, 0.2, 0.3}, Vec3(50.0, -20.0, 5.0)).calc_derivatives();
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(flying.rms[k], still.rms[k], 1e-8 * (1.0 + still.rms[k]));
}

TEST(VelocityTrack, KnowsOnlyWhatItHasSeen) {
  EXPECT_EQ(VelocityTrack().calc_derivatives().known, 0);
  EXPECT_EQ(make_track({0.0}).calc_derivatives().known, 1);
  EXPECT_EQ(make_track({0.0, 0.1, 0.2, 0.3, 0.4, 0.5}).calc_derivatives().known, 4);
}

TEST(VelocityTrack, ComesBackFromItsNumbers) {
  const VelocityTrack track = make_track({0.0, 0.1, 0.2, 0.25, 0.4});
  VelocityTrack other;
  ASSERT_TRUE(other.restore(track.save(), 6));
  EXPECT_EQ(other.calc_derivatives().rms, track.calc_derivatives().rms);
  EXPECT_EQ(other.save(), track.save());
}

TEST(VelocityTrack, RefusesNumbersThatAreNone) {
  const VecX saved = make_track({0.0, 0.1, 0.2, 0.3}).save();
  VelocityTrack track;
  EXPECT_FALSE(track.restore({}, 6));
  EXPECT_FALSE(track.restore(saved, 3));
  EXPECT_FALSE(track.restore(saved.head(saved.size() - 1), 6));
  VecX broken = saved;
  broken[0] = 2.5;
  EXPECT_FALSE(track.restore(broken, 6));
  broken = saved;
  broken[1] = -1.0;  // the newest point before the others
  EXPECT_FALSE(track.restore(broken, 6));
}

}  // namespace
}  // namespace flexcast
