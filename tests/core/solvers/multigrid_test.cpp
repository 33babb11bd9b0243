// Multigrid is a symmetric, positive preconditioner that needs hardly more iterations for finer meshes.
#include "core/solvers/multigrid.h"

#include <gtest/gtest.h>

#include <hwy/highway.h>

#include "core/base/parallel.h"
#include "core/forces/system.h"
#include "core/mesh/generators.h"
#include "core/solvers/block_jacobi.h"
#include "core/solvers/ldlt.h"
#include "core/solvers/pcg.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

struct Problem {
  BlockMatrix A;
  VecX rest, b;
};

// M / h^2 + K with gravity; `shake`: m, how far particles are from rest.
Problem make_problem(Model model, double h, double shake = 0.0) {
  update_masses(model);
  const System system(model);
  Problem problem{system.make_matrix(), model.rest_positions, -9.81 * system.masses()};
  SplitMix64 random(5);
  const VecX x = model.rest_positions + make_random_vector(random, model.rest_positions.size(), shake);
  system.add_stiffness(x, 1.0, Tangent::positive_semidefinite, problem.A);
  problem.A.add_diagonal(system.masses() / (h * h));
  problem.A.hold(system.free());
  problem.b = problem.b.cwiseProduct(system.free());
  return problem;
}

Model make_cantilever(int n, const Elastic& elastic) {
  const double width = 0.125;
  Model model = make_beam_model(make_beam({8 * n, n, n}, {8.0 * width, width, width}), elastic);
  for (std::int64_t i = 0; i < model.particle_count(); ++i) {
    if (model.rest_positions[3 * i] != 0.0) continue;
    for (std::int64_t k = 0; k < 3; ++k) model.fixed[static_cast<std::size_t>(3 * i + k)] = 1;
  }
  return model;
}

// A square cloth of n x n cells with diagonals, askew in space.
Model make_cloth_model(int n) {
  Points points;
  std::vector<Spring> springs;
  const Vec3 right = Vec3(1.0, 0.2, 0.3).normalized(), up = right.cross(Vec3(0.1, 0.3, 1.0)).normalized();
  const auto number = [&](int i, int j) { return static_cast<std::int32_t>(i * (n + 1) + j); };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      points.push_back(0.05 * (i * right + j * up));
      if (j < n) springs.push_back({number(i, j), number(i, j + 1)});
      if (i < n) springs.push_back({number(i, j), number(i + 1, j)});
      if (i < n && j < n) springs.push_back({number(i, j), number(i + 1, j + 1)});
    }
  }
  return make_spring_model(points, springs, {.stiffness = 1e4}, 0.01);
}

LinearResult solve_with_multigrid(const Problem& problem, double tolerance, VecX& x) {
  x = VecX::Zero(problem.b.size());
  return PcgSolver(tolerance, std::make_unique<Multigrid>(problem.rest)).solve(problem.A, problem.b, x);
}

void expect_same_as_direct(const Problem& problem) {
  VecX direct, x;
  ASSERT_TRUE(LdltSolver().solve(problem.A, problem.b, direct).positive_definite);
  const LinearResult result = solve_with_multigrid(problem, 1e-11, x);
  EXPECT_TRUE(result.positive_definite && result.converged) << result.iterations;
  EXPECT_LE((x - direct).norm(), 1e-6 * direct.norm()) << result.iterations;
  EXPECT_LE(result.iterations, 100);
}

TEST(Multigrid, SolvesWhatFactorisationSolves) {
  expect_same_as_direct(make_problem(make_cantilever(3, {}), 1.0 / 60));
  expect_same_as_direct(make_problem(make_cantilever(3, {}), 1.0 / 60, 0.004));
  expect_same_as_direct(make_problem(make_cantilever(3, {.young = 1e8, .poisson = 0.49}), 1.0 / 60));
  expect_same_as_direct(make_problem(make_cloth_model(20), 1.0 / 60, 0.01));
}

TEST(Multigrid, SolvesForBodiesThatNothingHolds) {
  Model free = make_cantilever(3, {.young = 1e9});
  free.fixed.assign(free.fixed.size(), 0);
  const Problem problem = make_problem(free, 1.0 / 60);
  VecX x;
  EXPECT_TRUE(solve_with_multigrid(problem, 1e-8, x).converged);
  // Gravity alone: everything falls alike.
  const VecX fallen = VecX::Constant(x.size(), -9.81 / 3600);
  EXPECT_LE((x - fallen).norm(), 1e-5 * fallen.norm());
}

TEST(Multigrid, SolvesWithHeldDirections) {
  Model model = make_cantilever(3, {});
  for (std::int64_t i = 0; i < model.particle_count(); i += 3) model.fixed[static_cast<std::size_t>(3 * i + i % 3)] = 1;
  expect_same_as_direct(make_problem(model, 1.0 / 60));
}

TEST(Multigrid, SolvesForSeveralBodiesAndLooseParticles) {
  // Two beams, one much stiffer, and a particle by itself.
  const Problem one = make_problem(make_cantilever(2, {}), 1.0 / 60);
  const Problem two = make_problem(make_cantilever(3, {.young = 1e9}), 1.0 / 60);
  const std::int32_t n = one.A.rows(), m = two.A.rows();
  BlockMatrix::Pairs pairs;
  for (std::int32_t i = 0; i < n; ++i) {
    for (const std::int32_t j : one.A.columns(i)) pairs.emplace_back(i, j);
  }
  for (std::int32_t i = 0; i < m; ++i) {
    for (const std::int32_t j : two.A.columns(i)) pairs.emplace_back(n + i, n + j);
  }
  Problem both{BlockMatrix(n + m + 1, pairs), VecX::Zero(3 * (n + m + 1)), VecX::Ones(3 * (n + m + 1))};
  both.rest << one.rest, two.rest, Vec3(9.0, 9.0, 9.0);
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < one.A.columns(i).size(); ++k) both.A.add(i, one.A.columns(i)[k], one.A.blocks(i)[k]);
  }
  for (std::int32_t i = 0; i < m; ++i) {
    for (std::size_t k = 0; k < two.A.columns(i).size(); ++k) {
      both.A.add(n + i, n + two.A.columns(i)[k], two.A.blocks(i)[k]);
    }
  }
  both.A.add(n + m, n + m, Mat3::Identity());
  expect_same_as_direct(both);
}

TEST(Multigrid, CoincidentRestPositionsStillGiveAPreconditioner) {
  Problem problem = make_problem(make_cantilever(2, {}), 1.0 / 60);
  problem.rest.setZero();
  VecX x;
  EXPECT_TRUE(solve_with_multigrid(problem, 1e-8, x).converged);
}

TEST(Multigrid, IterationsHardlyGrowWithTheMesh) {
  for (const double young : {1e6, 1e8}) {
    std::vector<int> iterations;
    for (const int n : {3, 6, 9}) {
      VecX x;
      const Problem problem = make_problem(make_cantilever(n, {.young = young, .poisson = 0.4}), 1.0 / 60);
      const LinearResult result = solve_with_multigrid(problem, 1e-6, x);
      EXPECT_TRUE(result.converged);
      iterations.push_back(result.iterations);
    }
    EXPECT_LT(iterations[2], 2 * iterations[0]) << young;
    EXPECT_LE(iterations[2], 30) << young;
  }
}

TEST(Multigrid, IsSymmetricAndPositive) {
  const Problem problem = make_problem(make_cantilever(6, {.poisson = 0.45}), 1.0 / 60, 0.001);
  Multigrid multigrid(problem.rest);
  ASSERT_TRUE(multigrid.setup(problem.A));
  EXPECT_GT(multigrid.level_sizes().size(), 2U);
  SplitMix64 random(8);
  for (int i = 0; i < 5; ++i) {
    const VecX u = make_random_vector(random, problem.b.size(), 1.0);
    const VecX v = make_random_vector(random, problem.b.size(), 1.0);
    VecX Mu, Mv;
    multigrid.apply(u, Mu);
    multigrid.apply(v, Mv);
    EXPECT_GT(u.dot(Mu), 0.0);
    EXPECT_LE(std::abs(u.dot(Mv) - v.dot(Mu)), 1e-12 * std::sqrt(u.dot(Mu) * v.dot(Mv)));
  }
}

TEST(Multigrid, GivesTheSameBitsForAnyNumberOfThreads) {
  const Problem problem = make_problem(make_cantilever(9, {}), 1.0 / 60, 0.001);
  VecX one, two;
  solve_with_multigrid(problem, 1e-6, one);
  set_thread_count(2);
  solve_with_multigrid(problem, 1e-6, two);
  set_thread_count(1);
  EXPECT_EQ(one, two);
}

TEST(Multigrid, GivesTheSameBitsWithAvx2AndAvx512) {
  if (!(hwy::SupportedTargets() & HWY_TARGETS & HWY_AVX3)) GTEST_SKIP() << "no AVX-512 here";
  const Problem problem = make_problem(make_cantilever(3, {}), 1.0 / 60, 0.001);
  VecX wide, narrow, plain;
  solve_with_multigrid(problem, 1e-6, wide);
  hwy::SetSupportedTargetsForTest(HWY_AVX2 | HWY_EMU128);
  solve_with_multigrid(problem, 1e-6, narrow);
  hwy::SetSupportedTargetsForTest(HWY_EMU128);
  solve_with_multigrid(problem, 1e-6, plain);
  hwy::SetSupportedTargetsForTest(0);
  EXPECT_EQ(wide, narrow);
  EXPECT_LE((wide - plain).norm(), 1e-5 * wide.norm());
}

TEST(Multigrid, IndefiniteMatricesAreSaidToBe) {
  Problem problem = make_problem(make_cantilever(3, {}), 1.0 / 60);
  problem.A.add_diagonal(VecX::Constant(problem.b.size(), -problem.A.diagonal(100).trace()));
  VecX x;
  EXPECT_FALSE(solve_with_multigrid(problem, 1e-8, x).positive_definite);
}

}  // namespace
}  // namespace flexcast::test
