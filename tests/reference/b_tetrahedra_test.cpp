// B04 to B07: one tetrahedron, its energy, forces and stiffness.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <numbers>

#include "core/materials/polar.h"
#include "tests/reference/golden_tet.h"
#include "tests/reference/tables.h"
#include "tests/support/dense.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

TEST(Reference, B04_EnergyAndForcesOfTheGoldenTetrahedronMatch) {
  for (const ReferenceLaw& law : reference_laws()) {
    const Model model = make_golden_tet(law.law);
    for (const auto& [name, state] : tet_vectors()["states"].items()) {
      SCOPED_TRACE(concat(law.law, " ", name));
      const Json& expected = state["mat"][std::string(law.key)];
      const VecX x = to_flat(state["x"]);
      EXPECT_NEAR(measure_elastic_energy(model, x), expected["energy"], 1e-12 * young);
      EXPECT_LE(calc_max_error(measure_forces(model, x), to_flat(expected["force"])), 1e-12 * young);
    }
  }
}

TEST(Reference, B04_StiffnessOfTheGoldenTetrahedronMatchesAndIsIndefiniteWhereItMustBe) {
  for (const ReferenceLaw& law : reference_laws()) {
    const Model model = make_golden_tet(law.law);
    for (const auto& [name, state] : tet_vectors()["states"].items()) {
      SCOPED_TRACE(concat(law.law, " ", name));
      const Json& expected = state["mat"][std::string(law.key)];
      const Eigen::MatrixXd K = calc_stiffness(model, to_flat(state["x"]));
      EXPECT_LE(calc_max_error(K, to_matrix(expected["K"])), 1e-9 * young);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(K);
      EXPECT_NEAR(solver.eigenvalues()[0], expected["K_eig_min"], 1e-9 * young);
      EXPECT_NEAR(solver.eigenvalues()[11], expected["K_eig_max"], 1e-9 * young);
    }
  }
}

TEST(Reference, B04_RotationsOfTheGoldenTetrahedronMatch) {
  for (const auto& [name, state] : tet_vectors()["states"].items()) {
    const Mat3 F = to_matrix(state["F"]);
    EXPECT_LE(calc_max_error(calc_polar(F).Q, to_matrix(state["mat"]["corot"]["Q"])), 1e-13) << name;
  }
}

double calc_two_smallest(const VecX& x, const Points& rest) {
  Mat3 Ds, Dm;
  for (int a = 0; a < 3; ++a) {
    Ds.col(a) = block3(x, a + 1) - block3(x, 0);
    Dm.col(a) = rest[static_cast<std::size_t>(a + 1)] - rest[0];
  }
  const Mat3 F = Ds * Dm.inverse();
  const Vec3 s = Eigen::JacobiSVD<Mat3>(F).singularValues();
  return s[1] + std::copysign(s[2], F.determinant());
}

// States near and far from rest; about half of the far ones are inverted. All away from the mirror singularity.
std::vector<VecX> make_states(const Points& rest, int count) {
  SplitMix64 random(5);
  std::vector<VecX> states;
  while (states.size() < static_cast<std::size_t>(count)) {
    const double size = states.size() % 2 == 0 ? 0.2 : 1.0;
    const VecX x = flatten(rest) + make_random_vector(random, 12, size);
    if (calc_two_smallest(x, rest) > 0.3) states.push_back(x);
  }
  return states;
}

TEST(Reference, B05_ForcesAreTheSlopeOfTheEnergyAndStiffnessThatOfTheForces) {
  const double step = 1e-6;
  int inverted = 0;
  for (const ReferenceLaw& law : reference_laws()) {
    const Model model = make_golden_tet(law.law);
    for (const VecX& x : make_states(golden_points(), 20)) {
      SCOPED_TRACE(law.law);
      const VecX f = measure_forces(model, x);
      const Eigen::MatrixXd K = calc_stiffness(model, x);
      inverted += Simulation(model, make_settings("rk4", 1.0), make_state(x), {}).calc_report().inverted > 0;
      EXPECT_LE(calc_max_error(K, K.transpose()), 1e-12 * K.cwiseAbs().maxCoeff());
      for (int i = 0; i < 12; ++i) {
        VecX plus = x, minus = x;
        plus[i] += step;
        minus[i] -= step;
        const double slope = (measure_elastic_energy(model, plus) - measure_elastic_energy(model, minus)) / (2 * step);
        EXPECT_NEAR(f[i], -slope, 1e-7 * young);
        const VecX change = (measure_forces(model, plus) - measure_forces(model, minus)) / (2 * step);
        EXPECT_LE(calc_max_error(K.col(i), -change), 1e-6 * young);
      }
    }
  }
  EXPECT_GT(inverted, 3);
}

TEST(Reference, B05_ForcesSumToZeroAndOnlyTheLinearLawHasAGhostTorque) {
  for (const ReferenceLaw& law : reference_laws()) {
    const Model model = make_golden_tet(law.law);
    for (const VecX& x : make_states(golden_points(), 20)) {
      const VecX f = measure_forces(model, x);
      EXPECT_LE(calc_sum(f).norm(), 1e-12 * young) << law.law;
      if (law.law != "linear") {
        EXPECT_LE(calc_torque(x, f).norm(), 1e-11 * young) << law.law;
      }
    }
  }
  const VecX moderate = to_flat(tet_vectors()["states"]["moderate"]["x"]);
  const Vec3 ghost = calc_torque(moderate, measure_forces(make_golden_tet("linear"), moderate));
  EXPECT_LE((ghost - Vec3(-257.077294686, 581.050724638, 1018.75362319)).norm(), 1e-7);
}

TEST(Reference, B06_RigidMotionCausesNoForcesExceptInTheLinearLaw) {
  SplitMix64 random(6);
  const Points rest = golden_points();
  for (int k = 0; k < 100; ++k) {
    const Mat3 R =
        k % 10 == 0 ? make_rotation(make_random_vector(random), std::numbers::pi) : make_random_rotation(random);
    const Vec3 shift = make_random_vector(random, 10.0 / std::sqrt(3.0));
    Points moved;
    for (const Vec3& X : rest) moved.emplace_back(R * X + shift);
    for (const ReferenceLaw& law : reference_laws()) {
      if (law.law == "linear") continue;
      const Model model = make_golden_tet(law.law);
      EXPECT_LE(measure_forces(model, flatten(moved)).cwiseAbs().maxCoeff(), 1e-10 * young) << law.law;
      EXPECT_NEAR(measure_elastic_energy(model, flatten(moved)), 0.0, 1e-20 * young) << law.law;
    }
  }
}

TEST(Reference, B06_LinearLawTakesAQuarterTurnForAStrain) {
  const VecX x = to_flat(tet_vectors()["states"]["rigid_rot_90z_plus_shift"]["x"]);
  const double volume = 0.23;
  EXPECT_NEAR(measure_elastic_energy(make_golden_tet("linear"), x) / volume, 250000.0, 1e-12 * 250000.0);
}

// lambda = mu = 6 Pa.
Eigen::MatrixXd calc_corner_stiffness(std::string_view law, Tangent kind) {
  const Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}}, {.law = law, .young = 15.0, .poisson = 0.25});
  return calc_stiffness(model, model.rest_positions, kind);
}

TEST(Reference, B07_StiffnessOfTheCornerTetrahedronIsTheTableOfIntegers) {
  Eigen::MatrixXd K(12, 12);
  K << 5, 2, 2, -3, -1, -1, -1, -1, 0, -1, 0, -1,  //
      2, 5, 2, -1, -1, 0, -1, -3, -1, 0, -1, -1,   //
      2, 2, 5, -1, 0, -1, 0, -1, -1, -1, -1, -3,   //
      -3, -1, -1, 3, 0, 0, 0, 1, 0, 0, 0, 1,       //
      -1, -1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0,        //
      -1, 0, -1, 0, 0, 1, 0, 0, 0, 1, 0, 0,        //
      -1, -1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0,        //
      -1, -3, -1, 1, 0, 0, 0, 3, 0, 0, 0, 1,       //
      0, -1, -1, 0, 0, 0, 0, 0, 1, 0, 1, 0,        //
      -1, 0, -1, 0, 0, 1, 0, 0, 0, 1, 0, 0,        //
      0, -1, -1, 0, 0, 0, 0, 0, 1, 0, 1, 0,        //
      -1, -1, -3, 1, 0, 0, 0, 1, 0, 0, 0, 3;
  const double root = 2.0 * std::sqrt(6.0);
  VecX eigenvalues(12);
  eigenvalues << 0, 0, 0, 0, 0, 0, 2, 2, 8 - root, 5, 5, 8 + root;
  for (const ReferenceLaw& law : reference_laws()) {
    for (const Tangent kind : {Tangent::exact, Tangent::positive_semidefinite}) {
      SCOPED_TRACE(law.law);
      const Eigen::MatrixXd found = calc_corner_stiffness(law.law, kind);
      EXPECT_LE(calc_max_error(found, K), 1e-13);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(found);
      EXPECT_LE(calc_max_error(VecX(solver.eigenvalues()), eigenvalues), 1e-13);
    }
  }
}

}  // namespace
}  // namespace flexcast::test
