// What every row of the table of laws must keep: the energy is zero and smallest at rest, stress and tangent are its
// derivatives, the projected tangent is the nearest positive semidefinite matrix, and (except `linear`) turning changes
// nothing.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <vector>

#include "core/materials/law.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

constexpr Lame lame{5e4, 7.5e4};     // Pa
constexpr double stiffness = 1.3e5;  // Pa, what errors are measured against
// Poisson's ratios of a body with that Young's modulus: lambda < 0, = 0, > 0 and >> mu.
constexpr double ratios[] = {-0.85, -0.4, 0.0, 0.3, 0.49};

double calc_energy(const Law& law, const Mat3& F, Lame of = lame) {
  double Psi = 0.0;
  law.calc_energy(of, {&F, 1}, {&Psi, 1});
  return Psi;
}

Mat3 calc_stress(const Law& law, const Mat3& F, Lame of = lame) {
  Mat3 P;
  law.calc_stress(of, {&F, 1}, {&P, 1});
  return P;
}

Mat9 calc_tangent(const Law& law, const Mat3& F, Tangent kind = Tangent::exact, Lame of = lame) {
  Mat9 dPdF;
  law.calc_tangent(of, kind, {&F, 1}, {&dPdF, 1});
  return dPdF;
}

// Signed: s1 >= s2 >= |s3|.
Vec3 calc_singular_values(const Mat3& F) {
  Vec3 s = Eigen::JacobiSVD<Mat3>(F).singularValues();
  s[2] = std::copysign(s[2], F.determinant());
  return s;
}

// Gradients near rest, far from it, flat and inverted; away from mirrors (s2 + s3 = 0), where rotations jump.
std::vector<Mat3> make_gradients(int count) {
  SplitMix64 random(7);
  std::vector<Mat3> gradients;
  int inverted = 0;
  while (gradients.size() < static_cast<std::size_t>(count)) {
    const double size = gradients.size() % 2 == 0 ? 0.1 : 2.0;
    Mat3 F = Mat3::Identity() + make_random_matrix(random, size);
    if (gradients.size() % 7 == 3) F.col(2) = F.col(1);
    const Vec3 s = calc_singular_values(F);
    if (s[1] + s[2] < 0.3) continue;
    gradients.push_back(F);
    inverted += s[2] < 0.0;
  }
  EXPECT_GT(inverted, count / 20);
  return gradients;
}

class LawKit : public testing::TestWithParam<Law> {
 protected:
  const Law& law_ = GetParam();
};

TEST_P(LawKit, IsFoundByItsName) {
  ASSERT_NE(find_law(law_.name), nullptr);
  EXPECT_EQ(find_law(law_.name)->calc_energy, law_.calc_energy);
  EXPECT_FALSE(law_.summary.empty());
}

TEST_P(LawKit, EnergyAndStressVanishAtRest) {
  EXPECT_NEAR(calc_energy(law_, Mat3::Identity()), 0.0, 1e-15 * stiffness);
  EXPECT_LE(calc_stress(law_, Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-15 * stiffness);
}

TEST_P(LawKit, EnergyIsNowhereBelowThatAtRest) {
  for (const double ratio : ratios) {
    const Lame of = calc_lame(stiffness, ratio);
    for (const Mat3& F : make_gradients(200)) EXPECT_GE(calc_energy(law_, F, of), -1e-13 * stiffness);
    for (double s = -1.5; s < 1.5; s += 0.01) {
      EXPECT_GE(calc_energy(law_, s * Mat3::Identity(), of), -1e-13 * stiffness) << ratio << " s=" << s;
    }
  }
}

// Also where a formula with differences of large terms would leave half the digits.
TEST_P(LawKit, EnergyOfSmallStrainsIsHookesToTheLastDigits) {
  SplitMix64 random(10);
  for (const double size : {1e-3, 1e-6, 1e-9}) {
    for (int i = 0; i < 20; ++i) {
      const Mat3 strain = make_random_matrix(random, size);
      const Mat3 e = 0.5 * (strain + strain.transpose());
      const Mat3 R = law_.small_strain ? Mat3(Mat3::Identity()) : make_random_rotation(random);
      const double hooke = lame.mu * e.squaredNorm() + 0.5 * lame.lambda * e.trace() * e.trace();
      EXPECT_NEAR(calc_energy(law_, R * (Mat3::Identity() + e)) / hooke, 1.0, 20.0 * size + 1e-14 / size);
    }
  }
}

TEST_P(LawKit, StressIsTheSlopeOfTheEnergy) {
  const double step = 1e-6;
  for (const Mat3& F : make_gradients(100)) {
    const Mat3 P = calc_stress(law_, F);
    for (int k = 0; k < 9; ++k) {
      Mat3 plus = F, minus = F;
      plus.data()[k] += step;
      minus.data()[k] -= step;
      const double slope = (calc_energy(law_, plus) - calc_energy(law_, minus)) / (2.0 * step);
      EXPECT_NEAR(P.data()[k], slope, 1e-8 * std::max(stiffness, calc_energy(law_, F)));
    }
  }
}

TEST_P(LawKit, TangentIsTheSlopeOfTheStressAndSymmetric) {
  const double step = 1e-6;
  for (const Mat3& F : make_gradients(100)) {
    const Mat9 tangent = calc_tangent(law_, F);
    EXPECT_LE((tangent - tangent.transpose()).cwiseAbs().maxCoeff(), 1e-12 * stiffness);
    for (int k = 0; k < 9; ++k) {
      Mat3 plus = F, minus = F;
      plus.data()[k] += step;
      minus.data()[k] -= step;
      const Mat3 slope = (calc_stress(law_, plus) - calc_stress(law_, minus)) / (2.0 * step);
      const Eigen::Map<const Eigen::Matrix<double, 9, 1>> column(slope.data());
      EXPECT_LE((tangent.col(k) - column).cwiseAbs().maxCoeff(), 1e-7 * stiffness);
    }
  }
}

TEST_P(LawKit, TangentAtRestIsHookesLaw) {
  const Mat9 tangent = calc_tangent(law_, Mat3::Identity());
  SplitMix64 random(8);
  for (int i = 0; i < 10; ++i) {
    const Mat3 dF = make_random_matrix(random);
    const Mat3 strain = 0.5 * (dF + dF.transpose());
    const Mat3 stress = 2.0 * lame.mu * strain + lame.lambda * strain.trace() * Mat3::Identity();
    const Eigen::Matrix<double, 9, 1> found = tangent * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(dF.data());
    EXPECT_LE((found - Eigen::Map<const Eigen::Matrix<double, 9, 1>>(stress.data())).cwiseAbs().maxCoeff(),
              1e-13 * stiffness);
  }
}

TEST_P(LawKit, ProjectedTangentIsPositiveSemidefiniteAndExactWhereThatIs) {
  int kept = 0, changed = 0;
  for (const Mat3& F : make_gradients(200)) {
    const Mat9 exact = calc_tangent(law_, F), projected = calc_tangent(law_, F, Tangent::positive_semidefinite);
    EXPECT_LE((projected - projected.transpose()).cwiseAbs().maxCoeff(), 1e-12 * stiffness);
    const double scale = std::max(stiffness, exact.cwiseAbs().maxCoeff());
    const Eigen::SelfAdjointEigenSolver<Mat9> of_projected(projected), of_exact(exact);
    EXPECT_GE(of_projected.eigenvalues()[0], -1e-12 * scale);
    if (of_exact.eigenvalues()[0] >= 0.0) {
      EXPECT_LE((projected - exact).cwiseAbs().maxCoeff(), 1e-12 * scale);
      ++kept;
    } else if (of_exact.eigenvalues()[0] < -1e-6 * scale) {
      EXPECT_GT((projected - exact).cwiseAbs().maxCoeff(), 1e-9 * scale);
      ++changed;
    }
  }
  if (law_.name == "linear") {
    EXPECT_EQ(changed, 0);
  } else {
    EXPECT_GT(kept, 5);
    EXPECT_GT(changed, 5);
  }
}

TEST_P(LawKit, ProjectedTangentIsTheNearestPositiveSemidefiniteMatrixForEveryPoissonRatio) {
  for (const double ratio : ratios) {
    const Lame of = calc_lame(stiffness, ratio);
    for (const Mat3& F : make_gradients(100)) {
      const Mat9 exact = calc_tangent(law_, F, Tangent::exact, of);
      const Eigen::SelfAdjointEigenSolver<Mat9> eigen(exact);
      const Mat9 nearest =
          eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
      const Mat9 projected = calc_tangent(law_, F, Tangent::positive_semidefinite, of);
      EXPECT_LE((projected - nearest).cwiseAbs().maxCoeff(), 1e-12 * std::max(stiffness, exact.norm())) << ratio;
    }
  }
}

TEST_P(LawKit, HugeGradientsGiveFiniteNumbers) {
  for (const double size : {1e10, 1e30}) {
    for (Mat3 F : make_gradients(100)) {
      F *= size;
      EXPECT_TRUE(std::isfinite(calc_energy(law_, F)));
      EXPECT_TRUE(calc_stress(law_, F).allFinite());
      EXPECT_TRUE(calc_tangent(law_, F).allFinite());
      EXPECT_TRUE(calc_tangent(law_, F, Tangent::positive_semidefinite).allFinite());
    }
  }
}

// Positive semidefinite everywhere, also where the exact tangent has no meaning.
TEST_P(LawKit, ProjectedTangentIsFiniteAndPositiveSemidefiniteAtSingularGradients) {
  std::vector<Mat3> gradients = {Mat3::Zero(), -Mat3::Identity()};
  for (const Vec3& s : {Vec3(1, 1, -1), Vec3(1, 0, 0), Vec3(1, 0.9, 0), Vec3(2, 1, -1), Vec3(1, 1, -1 + 1e-9),
                        Vec3(1, 1, -1 - 1e-9), Vec3(0, 0, 1e-200), Vec3(1e-12, 1e-12, -1e-12)}) {
    gradients.emplace_back(s.asDiagonal());
  }
  for (const Mat3& F : gradients) {
    EXPECT_TRUE(calc_stress(law_, F).allFinite());
    EXPECT_TRUE(std::isfinite(calc_energy(law_, F)));
    EXPECT_TRUE(calc_tangent(law_, F).allFinite());
    const Mat9 projected = calc_tangent(law_, F, Tangent::positive_semidefinite);
    ASSERT_TRUE(projected.allFinite()) << F;
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Mat9>(projected).eigenvalues()[0], -1e-12 * stiffness) << F;
  }
}

TEST_P(LawKit, TurningBeforeOrAfterChangesNothing) {
  if (law_.small_strain) return;  // small strains are not invariant
  SplitMix64 random(9);
  for (const Mat3& F : make_gradients(100)) {
    const Mat3 R = make_random_rotation(random);
    const double scale = stiffness * std::max(1.0, F.squaredNorm() * F.squaredNorm());
    EXPECT_NEAR(calc_energy(law_, R * F), calc_energy(law_, F), 1e-13 * scale);
    EXPECT_NEAR(calc_energy(law_, F * R), calc_energy(law_, F), 1e-13 * scale);
    EXPECT_LE((calc_stress(law_, R * F) - R * calc_stress(law_, F)).cwiseAbs().maxCoeff(), 1e-12 * scale);
    EXPECT_LE((calc_stress(law_, F * R) - calc_stress(law_, F) * R).cwiseAbs().maxCoeff(), 1e-12 * scale);
  }
}

TEST_P(LawKit, BatchesGiveTheBitsOfSingleCalls) {
  const std::vector<Mat3> F = make_gradients(37);
  std::vector<double> Psi(F.size());
  std::vector<Mat3> P(F.size());
  std::vector<Mat9> dPdF(F.size());
  law_.calc_energy(lame, F, Psi);
  law_.calc_stress(lame, F, P);
  law_.calc_tangent(lame, Tangent::exact, F, dPdF);
  for (std::size_t i = 0; i < F.size(); ++i) {
    EXPECT_EQ(Psi[i], calc_energy(law_, F[i]));
    EXPECT_EQ(P[i], calc_stress(law_, F[i]));
    EXPECT_EQ(dPdF[i], calc_tangent(law_, F[i]));
  }
  law_.calc_energy(lame, {}, {});
  law_.calc_stress(lame, {}, {});
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, LawKit, testing::ValuesIn(laws().begin(), laws().end()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(LawTable, NamesAreUniqueAndUnknownOnesAreNotFound) {
  for (const Law& law : laws()) {
    int same = 0;
    for (const Law& other : laws()) same += other.name == law.name;
    EXPECT_EQ(same, 1) << law.name;
  }
  EXPECT_EQ(find_law("rubber"), nullptr);
  EXPECT_EQ(find_law(""), nullptr);
}

TEST(Lame, FollowsFromYoungAndPoisson) {
  EXPECT_DOUBLE_EQ(calc_lame(15.0, 0.25).mu, 6.0);
  EXPECT_DOUBLE_EQ(calc_lame(15.0, 0.25).lambda, 6.0);
  EXPECT_EQ(calc_lame(2.0, 0.0).lambda, 0.0);
  EXPECT_LT(calc_lame(2.0, -0.3).lambda, 0.0);
}

}  // namespace
}  // namespace flexcast::test
