// One spring: energy, force and tangent belong together.
#include "core/forces/spring.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/support/random.h"

namespace flexcast::test {
namespace {

constexpr double k_s = 120.0;  // N
constexpr double r = 0.4;      // m

// Compressed, stretched, and in every direction.
std::vector<Vec3> make_directions() {
  SplitMix64 random(3);
  std::vector<Vec3> directions;
  while (directions.size() < 50) {
    const Vec3 d = make_random_vector(random, directions.size() % 2 == 0 ? 0.2 : 1.0);
    if (d.norm() > 0.05) directions.push_back(d);
  }
  return directions;
}

TEST(Spring, ForceIsTheSlopeOfTheEnergy) {
  const double step = 1e-6;
  for (const Vec3& d : make_directions()) {
    const Vec3 f = calc_spring_force(d, Vec3::Zero(), r, k_s, 0.0);
    for (int i = 0; i < 3; ++i) {
      // Moving p forward shortens d.
      const Vec3 shift = step * Vec3::Unit(i);
      const double slope = (calc_spring_energy(d - shift, r, k_s) - calc_spring_energy(d + shift, r, k_s)) / (2 * step);
      EXPECT_NEAR(f[i], -slope, 1e-7 * k_s);
    }
  }
}

TEST(Spring, TangentIsTheSlopeOfTheForce) {
  const double step = 1e-6;
  for (const Vec3& d : make_directions()) {
    const Mat3 K = calc_spring_tangent(d, r, k_s, Tangent::exact);
    EXPECT_LE((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-13 * k_s / r);
    for (int i = 0; i < 3; ++i) {
      const Vec3 shift = step * Vec3::Unit(i);
      const Vec3 change = (calc_spring_force(d - shift, Vec3::Zero(), r, k_s, 0.0) -
                           calc_spring_force(d + shift, Vec3::Zero(), r, k_s, 0.0)) /
                          (2 * step);
      EXPECT_LE((K.col(i) + change).cwiseAbs().maxCoeff(), 1e-6 * k_s / r);
    }
  }
}

TEST(Spring, TransverseStiffnessIsNegativeWhenCompressedAndCutAtZeroOnRequest) {
  const Vec3 d(0.1, 0, 0);
  const Mat3 exact = calc_spring_tangent(d, r, k_s, Tangent::exact);
  EXPECT_DOUBLE_EQ(exact(0, 0), k_s / r);
  EXPECT_DOUBLE_EQ(exact(1, 1), k_s * (1 / r - 1 / 0.1));
  const Mat3 cut = calc_spring_tangent(d, r, k_s, Tangent::positive_semidefinite);
  EXPECT_DOUBLE_EQ(cut(0, 0), k_s / r);
  EXPECT_EQ(cut(1, 1), 0.0);
  EXPECT_EQ(cut(2, 2), 0.0);
}

TEST(Spring, CutTangentIsPositiveSemidefiniteAndExactWhenStretched) {
  for (const Vec3& d : make_directions()) {
    const Mat3 exact = calc_spring_tangent(d, r, k_s, Tangent::exact);
    const Mat3 cut = calc_spring_tangent(d, r, k_s, Tangent::positive_semidefinite);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Mat3>(cut).eigenvalues()[0], -1e-12 * k_s / r);
    if (d.norm() >= r) {
      EXPECT_EQ(cut, exact);
    }
  }
}

TEST(Spring, DampingActsAlongTheSpringAndTakesEnergy) {
  SplitMix64 random(4);
  for (const Vec3& d : make_directions()) {
    const Vec3 v = make_random_vector(random);
    const Vec3 f = calc_spring_damping_force(d, v, r, 0.75);
    const double along = v.dot(d.normalized());
    EXPECT_LE((f - 0.75 / r * along * d.normalized()).norm(), 1e-14);
    EXPECT_GE(f.dot(v), 0.0);  // on p; q gets the opposite and moves with v relative to p
    const Vec3 both = calc_spring_force(d, v, r, k_s, 0.75);
    EXPECT_LE((both - f - calc_spring_force(d, v, r, k_s, 0.0)).norm(), 1e-13 * k_s);
  }
}

}  // namespace
}  // namespace flexcast::test
