// What single laws keep beyond the kit: the tangent of the corotational law up to its mirror, where the rotation jumps;
// what a mirrored body feels.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/materials/corotational.h"
#include "core/materials/neo_hookean.h"
#include "core/materials/st_venant_kirchhoff.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

constexpr Lame rubber{5e4, 7.5e4};  // Pa

Mat3 calc_stress(const Law& law, const Mat3& F) {
  Mat3 P;
  law.calc_stress(rubber, {&F, 1}, {&P, 1});
  return P;
}

Mat9 calc_tangent(const Law& law, const Mat3& F, Tangent kind) {
  Mat9 dPdF;
  law.calc_tangent(rubber, kind, {&F, 1}, {&dPdF, 1});
  return dPdF;
}

// F with these signed stretches, in axes of no special direction.
Mat3 make_gradient(const Vec3& stretches) {
  SplitMix64 random(11);
  const Mat3 U = make_random_rotation(random), V = make_random_rotation(random);
  return U * stretches.asDiagonal() * V.transpose();
}

TEST(CorotationalTangent, IsExactCloseToTheMirror) {
  for (const double gap : {0.1, 1e-2, 1e-3}) {
    const Mat3 F = make_gradient({1.2, 0.9, -0.9 + gap});
    const Mat9 tangent = calc_tangent(corotational_law, F, Tangent::exact);
    EXPECT_GT(tangent.norm(), 0.5 * 2.0 * rubber.mu / gap);  // the rotation turns ever faster
    const double step = 1e-4 * gap;
    for (int k = 0; k < 9; ++k) {
      Mat3 plus = F, minus = F;
      plus.data()[k] += step;
      minus.data()[k] -= step;
      const Mat3 slope = (calc_stress(corotational_law, plus) - calc_stress(corotational_law, minus)) / (2.0 * step);
      EXPECT_LE((tangent.col(k) - slope.reshaped()).cwiseAbs().maxCoeff(), 1e-6 * tangent.norm()) << gap;
    }
  }
}

// Below the mirror's clamp the tangent stays bounded, and the projected one of the size of the material.
TEST(CorotationalTangent, IsBoundedAtTheMirror) {
  for (const double gap : {1e-7, 1e-9, 1e-12, 0.0}) {
    const Mat3 F = make_gradient({1.0, 0.9, -0.9 + gap});
    EXPECT_LE(calc_tangent(corotational_law, F, Tangent::exact).norm(), 1e9 * (rubber.mu + rubber.lambda));
    const Mat9 projected = calc_tangent(corotational_law, F, Tangent::positive_semidefinite);
    EXPECT_LE(projected.norm(), 10.0 * (rubber.mu + rubber.lambda));
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Mat9>(projected).eigenvalues()[0], -1e-12 * rubber.mu);
  }
}

TEST(StVenantKirchhoff, TakesAMirroredBodyForOneAtRest) {
  const Mat3 F = make_gradient({1, 1, -1});
  double Psi = 0.0;
  st_venant_kirchhoff_law.calc_energy(rubber, {&F, 1}, {&Psi, 1});
  EXPECT_NEAR(Psi, 0.0, 1e-20 * rubber.mu);
  EXPECT_LE(calc_stress(st_venant_kirchhoff_law, F).norm(), 1e-14 * rubber.mu);
  EXPECT_LT(calc_stress(st_venant_kirchhoff_law, Vec3(1, 1, -1.1).asDiagonal())(2, 2), 0.0);
  EXPECT_GT(calc_stress(st_venant_kirchhoff_law, Vec3(1, 1, -0.9).asDiagonal())(2, 2), 0.0);
}

TEST(NeoHookean, PushesMirroredAndFlatBodiesBack) {
  for (const double s : {-2.0, -1.0, -0.1, 0.0, 0.1, 0.9}) {
    EXPECT_LT(calc_stress(neo_hookean_law, Vec3(1, 1, s).asDiagonal())(2, 2), 0.0) << s;
  }
}

TEST(NeoHookean, PushesEveryUniformlyShrunkBodyBackDownToAPoissonRatioOfMinus085) {
  const auto is_pushed_back = [](double ratio) {
    for (double s = 0.001; s < 0.999; s += 0.001) {
      const Mat3 F = s * Mat3::Identity();
      Mat3 P;
      neo_hookean_law.calc_stress(calc_lame(1.0, ratio), {&F, 1}, {&P, 1});
      if (P(0, 0) >= 0.0) return false;
    }
    return true;
  };
  for (const double ratio : {-0.851, -0.5, 0.0, 0.3, 0.45, 0.49, 0.499}) EXPECT_TRUE(is_pushed_back(ratio)) << ratio;
  EXPECT_FALSE(is_pushed_back(-0.852));
}

}  // namespace
}  // namespace flexcast::test
