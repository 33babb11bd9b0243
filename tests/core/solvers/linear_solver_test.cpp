// The linear solvers agree with dense algebra.
#include "core/solvers/linear_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>

#include "tests/support/dense.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

Pairs make_pairs(std::int32_t rows, SplitMix64& random) {
  Pairs pairs;
  for (std::int32_t i = 0; i < rows; ++i) {
    for (int k = 0; k < 3; ++k) pairs.emplace_back(i, static_cast<std::int32_t>(random.uniform() * rows));
  }
  return pairs;
}

// Sums of B^T B over pairs of particles, as stiffness matrices are, plus masses.
BlockMatrix make_positive_definite(std::int32_t rows, double mass, SplitMix64& random) {
  const Pairs pairs = make_pairs(rows, random);
  BlockMatrix A(rows, pairs);
  A.set_zero();
  for (const auto& [i, j] : pairs) {
    const Mat3 B = make_random_matrix(random), C = make_random_matrix(random);
    A.add(i, i, B.transpose() * B);
    if (i == j) continue;
    A.add(i, j, B.transpose() * C);
    A.add(j, i, C.transpose() * B);
    A.add(j, j, C.transpose() * C);
  }
  A.add_diagonal(VecX::Constant(3 * rows, mass));
  return A;
}

std::unique_ptr<LinearSolver> make_solver(const std::string& name, double tolerance, std::int64_t particles) {
  SplitMix64 random(99);
  SolverSettings settings;
  settings.linear = name;
  settings.linear_tolerance = tolerance;
  return make_linear_solver(settings, make_random_vector(random, 3 * particles, 1.0));
}

TEST(BlockMatrix, HasBothTrianglesAndTheWholeDiagonal) {
  BlockMatrix A(4, {{0, 2}, {2, 0}, {0, 2}, {3, 1}});
  EXPECT_EQ(A.rows(), 4);
  EXPECT_EQ(A.block_count(), 8);
  A.set_zero();
  A.add(2, 0, Mat3::Identity());
  A.add(2, 0, Mat3::Identity());
  A.add_diagonal(VecX::LinSpaced(12, 1, 12));
  const Eigen::MatrixXd dense = to_dense(A);
  EXPECT_EQ((dense.block<3, 3>(6, 0)), 2.0 * Mat3::Identity());
  EXPECT_EQ((dense.block<3, 3>(0, 6)), Mat3::Zero());
  EXPECT_EQ(VecX(dense.diagonal()), VecX::LinSpaced(12, 1, 12));
  EXPECT_EQ(A.diagonal(1), Mat3(dense.block<3, 3>(3, 3)));
  A.set_zero();
  EXPECT_TRUE(to_dense(A).isZero(0.0));
}

TEST(BlockMatrix, PatternsHaveNumbersThatCopiesKeep) {
  const BlockMatrix A(3, {{0, 1}}), B(3, {{0, 1}});
  const BlockMatrix copy = A;
  EXPECT_EQ(copy.pattern_id(), A.pattern_id());
  EXPECT_NE(B.pattern_id(), A.pattern_id());
  EXPECT_EQ(A.find(1, 0), 2);
  EXPECT_EQ(A.find(2, 2), 4);
}

TEST(BlockMatrix, BlocksAreReachedByNumber) {
  BlockMatrix A(3, {{0, 1}});
  A.value(A.find(1, 0))[3] = 5.0;
  EXPECT_EQ(to_dense(A)(3, 1), 5.0);
}

TEST(BlockMatrix, MultipliesLikeItsDenseForm) {
  SplitMix64 random(1);
  const BlockMatrix A = make_positive_definite(40, 0.1, random);
  const VecX x = make_random_vector(random, 120, 1.0);
  VecX y;
  A.multiply(x, y);
  const Eigen::MatrixXd dense = to_dense(A);
  EXPECT_LE((y - dense * x).cwiseAbs().maxCoeff(), 1e-13 * dense.cwiseAbs().maxCoeff());
}

TEST(BlockMatrix, HeldRowsAndColumnsBecomeThoseOfTheIdentity) {
  SplitMix64 random(2);
  BlockMatrix A = make_positive_definite(10, 0.1, random);
  Eigen::MatrixXd expected = to_dense(A);
  VecX free = VecX::Ones(30);
  for (const Eigen::Index i : {0, 7, 8, 29}) {
    free[i] = 0.0;
    expected.row(i).setZero();
    expected.col(i).setZero();
    expected(i, i) = 1.0;
  }
  A.hold(free);
  EXPECT_EQ(to_dense(A), expected);
}

TEST(LinearSolver, DirectAndIterativeSolutionsAreTheDenseOne) {
  SplitMix64 random(3);
  for (const std::int32_t rows : {1, 2, 30, 100}) {
    for (const double mass : {1.0, 1e-3}) {
      const BlockMatrix A = make_positive_definite(rows, mass, random);
      const VecX b = make_random_vector(random, 3 * rows, 1.0);
      const VecX exact = to_dense(A).ldlt().solve(b);
      VecX x = VecX::Zero(3 * rows);
      const LinearResult direct = make_solver("ldlt", 1e-6, rows)->solve(A, b, x);
      EXPECT_TRUE(direct.positive_definite && direct.converged);
      EXPECT_LE((x - exact).norm(), 1e-9 * exact.norm()) << rows << " " << mass;
      x.setZero();
      const LinearResult iterative = make_solver("pcg", 1e-12, rows)->solve(A, b, x);
      EXPECT_TRUE(iterative.positive_definite && iterative.converged);
      EXPECT_GT(iterative.iterations, 0);
      EXPECT_LE((to_dense(A) * x - b).norm(), 2e-12 * b.norm()) << rows << " " << mass;
      EXPECT_LE((x - exact).norm(), 1e-8 * exact.norm()) << rows << " " << mass;
    }
  }
}

TEST(LinearSolver, AutoChoosesASolverThatSolves) {
  SplitMix64 random(4);
  for (const std::int32_t particles : {30, 400}) {
    const BlockMatrix A = make_positive_definite(particles, 0.1, random);
    const VecX b = make_random_vector(random, 3 * particles, 1.0);
    VecX x = VecX::Zero(3 * particles);
    EXPECT_TRUE(make_solver("auto", 1e-10, particles)->solve(A, b, x).converged);
    EXPECT_LE((to_dense(A) * x - b).norm(), 1e-9 * b.norm());
  }
}

TEST(LinearSolver, SolversCanBeUsedAgainWithNewValues) {
  SplitMix64 random(5);
  for (const char* name : {"ldlt", "pcg"}) {
    BlockMatrix A = make_positive_definite(20, 1.0, random);
    const auto solver = make_solver(name, 1e-12, 20);
    const VecX b = make_random_vector(random, 60, 1.0);
    for (int i = 0; i < 3; ++i) {
      VecX x = VecX::Zero(60);
      ASSERT_TRUE(solver->solve(A, b, x).converged) << name;
      EXPECT_LE((to_dense(A) * x - b).norm(), 1e-11 * b.norm()) << name;
      A.add_diagonal(VecX::Constant(60, 10.0));
    }
  }
}

TEST(LinearSolver, AFactorServesAgainUntilAValueChanges) {
  SplitMix64 random(9);
  BlockMatrix A = make_positive_definite(20, 1.0, random);
  const auto solver = make_solver("ldlt", 1e-12, 20);
  for (int i = 0; i < 4; ++i) {
    const VecX b = make_random_vector(random, 60, 1.0);
    VecX x = VecX::Zero(60), same = x;
    ASSERT_TRUE(solver->solve(A, b, x).positive_definite);
    ASSERT_TRUE(make_solver("ldlt", 1e-12, 20)->solve(A, b, same).positive_definite);
    EXPECT_EQ(x, same);
    if (i == 1) *A.value(A.find(7, 7)) += 0.5;
  }
  A.add_diagonal(VecX::Constant(60, -100.0));
  for (int i = 0; i < 2; ++i) {
    VecX x = VecX::Zero(60);
    EXPECT_FALSE(solver->solve(A, VecX::Ones(60), x).positive_definite);
  }
}

TEST(LinearSolver, ZeroRightHandSideGivesZero) {
  SplitMix64 random(6);
  const BlockMatrix A = make_positive_definite(5, 1.0, random);
  for (const char* name : {"ldlt", "pcg"}) {
    VecX x = VecX::Zero(15);
    EXPECT_TRUE(make_solver(name, 1e-10, 5)->solve(A, VecX::Zero(15), x).converged) << name;
    EXPECT_EQ(x, VecX::Zero(15)) << name;
  }
}

TEST(LinearSolver, IndefiniteMatricesAreSaidToBe) {
  SplitMix64 random(7);
  BlockMatrix A = make_positive_definite(8, 0.1, random);
  A.add_diagonal(VecX::Constant(24, -2.0));
  const VecX eigenvalues = to_dense(A).selfadjointView<Eigen::Lower>().eigenvalues();
  ASSERT_LT(eigenvalues.minCoeff(), 0.0);
  ASSERT_GT(eigenvalues.maxCoeff(), 0.0);
  for (const char* name : {"ldlt", "pcg"}) {
    VecX x = VecX::Zero(24);
    EXPECT_FALSE(make_solver(name, 1e-10, 8)->solve(A, make_random_vector(random, 24, 1.0), x).positive_definite)
        << name;
  }
}

TEST(LinearSolver, NonFiniteMatricesEndWithoutClaimingSuccess) {
  SplitMix64 random(8);
  BlockMatrix A = make_positive_definite(8, 1.0, random);
  A.add(3, 3, Mat3::Constant(std::numeric_limits<double>::quiet_NaN()));
  for (const char* name : {"ldlt", "pcg"}) {
    VecX x = VecX::Zero(24);
    const LinearResult result = make_solver(name, 1e-10, 8)->solve(A, VecX::Ones(24), x);
    EXPECT_FALSE(result.positive_definite && result.converged) << name;
  }
}

}  // namespace
}  // namespace flexcast::test
