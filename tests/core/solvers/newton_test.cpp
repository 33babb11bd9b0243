// Newton's method finds minima, also from where the hessian is indefinite.
#include "core/solvers/newton.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace flexcast::test {
namespace {

SolverSettings settings(int iterations, double tolerance = 1e-12) {
  SolverSettings s;
  s.linear = "ldlt";
  s.newton_iterations = iterations;
  s.newton_tolerance = tolerance;
  return s;
}

// sum of w_i (u_i - c_i)^2 / 2.
class Quadratic final : public MinimizationProblem {
 public:
  Value calc_value(const VecX& u) override {
    const double value = 0.5 * (u - center).cwiseAbs2().dot(weights);
    return {value, value};
  }
  double calc_gradient(const VecX& u, VecX& gradient) override {
    gradient = weights.cwiseProduct(u - center);
    return weights.cwiseProduct(u).norm() + weights.cwiseProduct(center).norm();
  }
  void calc_hessian(const VecX&, bool, BlockMatrix& hessian) override {
    hessian.set_zero();
    hessian.add_diagonal(weights);
  }
  VecX weights = VecX::LinSpaced(6, 1.0, 100.0), center = VecX::LinSpaced(6, -3.0, 2.0);
};

// sum of u_i^4 / 4 - u_i^2 / 2: minima at +-1, a maximum at 0.
class DoubleWell final : public MinimizationProblem {
 public:
  Value calc_value(const VecX& u) override {
    const double quartic = 0.25 * u.cwiseAbs2().squaredNorm(), quadratic = 0.5 * u.squaredNorm();
    return {quartic - quadratic, quartic + quadratic};
  }
  double calc_gradient(const VecX& u, VecX& gradient) override {
    const VecX cube = u.array().cube();
    gradient = cube - u;
    return cube.norm() + u.norm();
  }
  void calc_hessian(const VecX& u, bool exact, BlockMatrix& hessian) override {
    hessian.set_zero();
    const Eigen::ArrayXd second = 3.0 * u.array().square() - 1.0;
    hessian.add_diagonal(exact ? VecX(second) : VecX(second.max(0.1)));
  }
};

TEST(Newton, SolvesAQuadraticInOneIteration) {
  Quadratic problem;
  BlockMatrix hessian(2, {});
  for (const int iterations : {1, 20}) {
    VecX u = VecX::Zero(6);
    NewtonSolver solver(settings(iterations), VecX::Zero(6));
    const NewtonResult result = solver.minimize(problem, hessian, VecX::Zero(6), u);
    EXPECT_EQ(result.iterations, 1);
    EXPECT_LE((u - problem.center).norm(), 1e-14 * problem.center.norm());
    EXPECT_LE(result.residual, 1e-13);
    EXPECT_TRUE(result.converged);
  }
}

TEST(Newton, FindsMinimaFromWhereTheHessianIsIndefinite) {
  DoubleWell problem;
  BlockMatrix hessian(2, {});
  SplitMix64 random(1);
  for (int k = 0; k < 20; ++k) {
    VecX u = make_random_vector(random, 6, 0.5);
    NewtonSolver solver(settings(100), VecX::Zero(6));
    const NewtonResult result = solver.minimize(problem, hessian, VecX::Zero(6), u);
    EXPECT_TRUE(result.converged);
    EXPECT_LE((u.cwiseAbs() - VecX::Ones(6)).cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(Newton, NeverGoesUphill) {
  DoubleWell problem;
  BlockMatrix hessian(2, {});
  SplitMix64 random(2);
  for (int k = 0; k < 20; ++k) {
    VecX u = make_random_vector(random, 6, 3.0);
    for (int i = 0; i < 10; ++i) {
      const double before = problem.calc_value(u).value;
      NewtonSolver solver(settings(2, 1e-14), VecX::Zero(6));
      (void)solver.minimize(problem, hessian, VecX::Zero(6), u);
      EXPECT_LE(problem.calc_value(u).value, before + 1e-14);
    }
  }
}

TEST(Newton, SaysWhenItDidNotConverge) {
  DoubleWell problem;
  BlockMatrix hessian(2, {});
  VecX u = VecX::Constant(6, 50.0);
  NewtonSolver solver(settings(2), VecX::Zero(6));
  const NewtonResult result = solver.minimize(problem, hessian, VecX::Zero(6), u);
  EXPECT_FALSE(result.converged);
  EXPECT_GT(result.residual, 1e-12);
  EXPECT_LE(result.iterations, 2);
}

}  // namespace
}  // namespace flexcast::test
