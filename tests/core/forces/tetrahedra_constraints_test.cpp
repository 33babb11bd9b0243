// Tetrahedra as compliant constraints C = sqrt(2 U). Sweeps that converge end where M (x - x~) = sum of grad C dlambda
// over the way there; the better the directions of grad C stay on that way, that is for small h omega, the closer this
// is to the backward Euler step M (x - x~) = -h^2 grad U.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "tests/support/dense.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

struct Tets {
  std::string name;
  Model model;
};

std::vector<Tets> make_all(const Mesh& mesh) {
  std::vector<Tets> all;
  for (const Law& law : laws()) {
    all.push_back({std::string(law.name), make_beam_model(mesh, {.law = law.name})});
    all.push_back({std::string(law.name) + " tet10", make_quadratic_model(mesh, {.law = law.name})});
  }
  for (Tets& tets : all) update_masses(tets.model);
  return all;
}

const Mesh one_tet{{{0, 0, 0}, {1.1, 0.1, 0}, {-0.1, 0.9, 0.2}, {0.1, 0, 1.2}}, {{0, 1, 2, 3}}, {}, {}};

// After a number of sweeps that start at x~.
VecX sweep_from(const System& system, double h, const VecX& predicted, int sweeps, const VecX& start) {
  VecX u = predicted - start;
  const ConstraintSweep sweep{h, start, system.inverse_masses()};
  for (const Force* force : system.active_forces()) {
    std::vector<double> lambda(static_cast<std::size_t>(force->constraint_count()), 0.0);
    for (int k = 0; k < sweeps; ++k) force->sweep_constraints(sweep, lambda, u);
  }
  return start + u;
}

// Newton's method on M (x - x~) + h^2 grad U = 0.
VecX solve_backward_euler(const System& system, double h, const VecX& predicted) {
  VecX x = predicted, f;
  BlockMatrix K = system.make_matrix();
  for (int k = 0; k < 50; ++k) {
    K.set_zero();
    system.add_stiffness(x, 1.0, Tangent::positive_semidefinite, K);
    Eigen::MatrixXd A = h * h * to_dense(K);
    A.diagonal() += system.masses();
    system.calc_conservative(x, f);
    VecX r = system.masses().cwiseProduct(x - predicted) - h * h * f;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      if (system.free()[i] != 0.0) continue;
      A.row(i).setZero();
      A.col(i).setZero();
      A(i, i) = 1.0;
      r[i] = 0.0;
    }
    x -= A.ldlt().solve(r);
  }
  return x;
}

// Of converged sweeps, as a part of what the elements do in the step.
double calc_error(const Tets& tets, double h, int sweeps) {
  const System system(tets.model);
  SplitMix64 random(21);
  const VecX away = make_random_vector(random, system.dofs(), 0.02);
  const VecX predicted = tets.model.rest_positions + system.free().cwiseProduct(away);
  const VecX expected = solve_backward_euler(system, h, predicted);
  const VecX x = sweep_from(system, h, predicted, sweeps, tets.model.rest_positions);
  return (x - expected).norm() / (expected - predicted).norm();
}

void expect_convergence(const Tets& tets, int sweeps) {
  const double coarse = calc_error(tets, 2e-3, sweeps), fine = calc_error(tets, 5e-4, sweeps);
  EXPECT_LE(coarse, 0.1) << tets.name;
  EXPECT_NEAR(coarse / fine, 16.0, 3.0) << tets.name;
}

TEST(TetrahedraConstraints, SweepsOverOneElementApproachTheBackwardEulerStepAtSecondOrder) {
  for (const Tets& tets : make_all(one_tet)) expect_convergence(tets, 500);
}

TEST(TetrahedraConstraints, SweepsOverABeamApproachTheBackwardEulerStepAtSecondOrder) {
  for (Tets& tets : make_all(make_beam({3, 1, 1}, {1.5, 0.5, 0.5}))) {
    for (std::int64_t i = 0; i < tets.model.particle_count(); ++i) {
      if (block3(tets.model.rest_positions, i).x() == 0.0) std::fill_n(&tets.model.fixed[3 * i], 3, std::uint8_t{1});
    }
    expect_convergence(tets, 500);
  }
}

// lambda = -h^2 C / (h^2 W + 1) solves the constraint of one element as far as C is linear.
TEST(TetrahedraConstraints, OneSweepSolvesTheLinearisedConstraint) {
  constexpr double h = 5e-3;  // s
  for (const Tets& tets : make_all(one_tet)) {
    const System system(tets.model);
    SplitMix64 random(24);
    const VecX predicted = tets.model.rest_positions + make_random_vector(random, system.dofs(), 0.02);
    VecX f;
    system.calc_conservative(predicted, f);
    const double C = std::sqrt(2.0 * system.calc_energy(EnergyKind::elastic, predicted));
    const VecX grad_C = -f / C;
    const VecX weighted = system.inverse_masses().cwiseProduct(grad_C);
    const VecX expected = predicted - h * h * C / (h * h * weighted.dot(grad_C) + 1.0) * weighted;
    const VecX x = sweep_from(system, h, predicted, 1, tets.model.rest_positions);
    EXPECT_LE((x - expected).norm(), 1e-12 * (expected - predicted).norm()) << tets.name;
  }
}

// One element: M (x - x~) + h^2 grad U + h beta grad C (grad C . (x - start)) = 0.
TEST(TetrahedraConstraints, DampingActsOnTheRateOfTheConstraint) {
  constexpr double h = 5e-4, beta = 2e-3;  // s
  for (Tets& tets : make_all(one_tet)) {
    tets.model.bodies[0].stiffness_damping = beta;
    const System system(tets.model);
    SplitMix64 random(22);
    const VecX start = tets.model.rest_positions + make_random_vector(random, system.dofs(), 0.05);
    const VecX predicted = start + make_random_vector(random, system.dofs(), 0.02);
    const VecX x = sweep_from(system, h, predicted, 200, start);
    VecX f;
    system.calc_conservative(x, f);
    const VecX grad_C = -f / std::sqrt(2.0 * system.calc_energy(EnergyKind::elastic, x));
    const VecX damping = h * beta * grad_C * grad_C.dot(x - start);
    const VecX residual = system.masses().cwiseProduct(x - predicted) - h * h * f + damping;
    EXPECT_LE(residual.norm(), 0.1 * damping.norm()) << tets.name;
  }
}

TEST(TetrahedraConstraints, AnElementAtRestIsLeftAlone) {
  for (const Tets& tets : make_all(one_tet)) {
    const System system(tets.model);
    const VecX& rest = tets.model.rest_positions;
    EXPECT_LE((sweep_from(system, 0.01, rest, 3, rest) - rest).cwiseAbs().maxCoeff(), 1e-14) << tets.name;
  }
}

TEST(TetrahedraConstraints, EveryStateStaysFinite) {
  SplitMix64 random(23);
  for (Tets& tets : make_all(one_tet)) {
    tets.model.bodies[0].stiffness_damping = 1e-3;
    const System system(tets.model);
    for (const double size : {0.0, 1e-300, 1e-160, 1e-8, 1.0, 10.0, 1e3, 1e50, 1e80, 1e150, 1e300}) {
      const VecX x = make_random_vector(random, system.dofs(), size);
      EXPECT_TRUE(sweep_from(system, 0.01, x, 5, tets.model.rest_positions).allFinite()) << tets.name << " " << size;
    }
  }
}

}  // namespace
}  // namespace flexcast::test
