// D01 to D04: the polar decomposition.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/materials/polar.h"
#include "tests/support/random.h"
#include "tests/support/reference.h"

namespace flexcast::test {
namespace {

const Json& vectors() {
  static const Json json = load_reference("polar_vectors.json");
  return json;
}

void expect_rotation(const Mat3& Q) {
  ASSERT_TRUE(Q.allFinite());
  EXPECT_LE(calc_max_error(Q.transpose() * Q, Mat3::Identity()), 1e-14);
  EXPECT_NEAR(Q.determinant(), 1.0, 1e-13);
}

TEST(Reference, D01_RotationsMatchTheTwentyVectorsWithinTheirConditioning) {
  ASSERT_EQ(vectors()["unique"].size(), 20u);
  for (const Json& row : vectors()["unique"]) {
    SCOPED_TRACE(row["name"].get<std::string>());
    const Mat3 F = to_matrix(row["F"]), S = to_matrix(row["S"]);
    const double tolerance = row["tol_Q_maxabs"];
    const Polar polar = calc_polar(F);
    expect_rotation(polar.Q);
    EXPECT_LE(calc_max_error(polar.Q, to_matrix(row["Q"])), tolerance);
    EXPECT_LE(calc_max_error(polar.S, S), tolerance * S.norm());
    EXPECT_EQ(polar.S, polar.S.transpose());
    EXPECT_EQ(polar.Q, calc_rotation(F));
  }
}

TEST(Reference, D02_WhereTheRotationIsNotUniqueANearestOneIsReturned) {
  ASSERT_EQ(vectors()["non_unique_property_only"].size(), 4u);
  for (const Json& row : vectors()["non_unique_property_only"]) {
    SCOPED_TRACE(row["name"].get<std::string>());
    const Mat3 F = to_matrix(row["F"]);
    const Mat3 Q = calc_polar(F).Q;
    expect_rotation(Q);
    EXPECT_NEAR((Q.transpose() * F).trace(), row["max_trace"], 1e-14);
  }
}

// s1 >= s2 >= |s3| with s2 + s3 >= 0.1, and the F made of them.
Mat3 make_well_conditioned(SplitMix64& random) {
  const double s1 = random.uniform(0.5, 2.0), s2 = random.uniform(0.3, s1);
  const double s3 = random.uniform(-s2 + 0.1, s2);
  return make_random_rotation(random) * Vec3(s1, s2, s3).asDiagonal() * make_random_rotation(random).transpose();
}

// 16 eps kappa with the floor the vectors have; kappa = 2 s1 / (s2 + s3) is at most 40 here. Two rounded rotations
// enter besides the decomposition.
constexpr double tolerance = 3.0 * 16.0 * 2.2e-16 * 40.0;

TEST(Reference, D03_RotationOfARotatedGradientIsTheRotatedRotation) {
  SplitMix64 random(31);
  for (int i = 0; i < 1000; ++i) {
    const Mat3 F = make_well_conditioned(random), R = make_random_rotation(random);
    const Mat3 Q = calc_rotation(F);
    ASSERT_LE(calc_max_error(calc_rotation(R * F), R * Q), tolerance);
    ASSERT_LE(calc_max_error(calc_rotation(F * R), Q * R), tolerance);
  }
}

TEST(Reference, D03_RotationDoesNotDependOnThePowerOfTwoOfTheScale) {
  SplitMix64 random(32);
  for (int i = 0; i < 1000; ++i) {
    const Mat3 F = make_well_conditioned(random);
    for (const int power : {-300, -40, -1, 3, 27, 300}) {
      ASSERT_LE(calc_max_error(calc_rotation(std::ldexp(1.0, power) * F), calc_rotation(F)), 4e-15) << power;
    }
  }
}

TEST(Reference, D03_RotationOfARotationIsItself) {
  SplitMix64 random(33);
  for (int i = 0; i < 1000; ++i) {
    const Mat3 Q = calc_rotation(make_well_conditioned(random));
    ASSERT_LE(calc_max_error(calc_rotation(Q), Q), 4e-15);
  }
}

TEST(Reference, D03_RotationsAreOrthogonalAndProperWhateverTheGradient) {
  SplitMix64 random(34);
  int inverted = 0;
  for (int i = 0; i < 1000; ++i) {
    Mat3 F = make_random_matrix(random);
    if (i % 5 == 1) F.col(2) = F.col(0);                          // rank 2
    if (i % 5 == 2) F *= std::pow(10.0, random.uniform(-12, 8));  // scales
    if (i % 5 == 3) F.col(1) *= 1e-9;                             // nearly flat
    inverted += F.determinant() < 0.0;
    expect_rotation(calc_rotation(F));
  }
  EXPECT_GT(inverted, 200);
}

// Q maximises tr(Q^T F): no nearby rotation does better, and neither do the three half turns away.
TEST(Reference, D03_NoOtherRotationIsNearer) {
  SplitMix64 random(35);
  for (int i = 0; i < 1000; ++i) {
    const Mat3 F = make_random_matrix(random);
    const Mat3 Q = calc_rotation(F);
    const double best = (Q.transpose() * F).trace();
    for (const double angle : {1e-3, 0.1, 1.0, 3.14159}) {
      const Mat3 other = Q * make_rotation(make_random_vector(random), angle);
      ASSERT_GE(best, (other.transpose() * F).trace() - 1e-14);
    }
  }
}

TEST(Reference, D04_RotationDoesNotJumpOnThePathThroughFlat) {
  const auto calc = [](double t) { return calc_rotation(Vec3(1.0, 0.9, t).asDiagonal()); };
  EXPECT_LE(calc_max_error(calc(1e-12), calc(-1e-12)), 1e-11);
  SplitMix64 random(4);
  for (int i = 0; i < 100; ++i) {
    const Mat3 U = make_random_rotation(random), V = make_random_rotation(random);
    const auto calc_turned = [&](double t) {
      return calc_rotation(U * Vec3(1.0, 0.9, t).asDiagonal() * V.transpose());
    };
    ASSERT_LE(calc_max_error(calc_turned(1e-12), calc_turned(-1e-12)), 1e-11);
    ASSERT_LE(calc_max_error(calc_turned(0.0), U * V.transpose()), 1e-13);
  }
}

}  // namespace
}  // namespace flexcast::test
