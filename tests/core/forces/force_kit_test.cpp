// What all forces together must keep: the conservative part is the slope of the energies, the matrices are the slopes
// of the forces, damping takes energy, and inside a free body everything cancels.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/support/dense.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

struct ForceScene {
  const char* name;
  Model (*make)();
  double force;      // N, what errors are measured against
  double stiffness;  // N/m
};

Model make_springs_only() {
  const Mesh mesh = make_grid({2, 2}, {1.0, 1.0});
  return make_spring_model(mesh.nodes, mesh.springs, {.stiffness = 50.0, .damping = 0.4}, 0.1);
}

Model make_tetrahedra_only(std::string_view law) {
  Model model = make_beam_model(make_beam({2, 1, 1}, {1.0, 0.5, 0.5}), {.law = law, .young = 2e4});
  model.bodies[0].stiffness_damping = 1e-2;
  return model;
}

Model make_everything() {
  Model model = make_tetrahedra_only("corotational");
  model.gravity = {1, -2, 3};
  model.bodies[0].mass_damping = 0.7;
  model.bodies[0].drag = 0.3;
  SplitMix64 random(1);
  model.external_forces = make_random_vector(random, model.rest_positions.size(), 5.0);
  return model;
}

const std::vector<ForceScene>& scenes() {
  static const std::vector<ForceScene> list = {
      {"springs", make_springs_only, 50.0, 200.0},
      {"linear", [] { return make_tetrahedra_only("linear"); }, 2e4, 2e4},
      {"corotational", [] { return make_tetrahedra_only("corotational"); }, 2e4, 2e4},
      {"everything", make_everything, 2e4, 2e4}};
  return list;
}

class ForceKit : public testing::TestWithParam<ForceScene> {
 protected:
  void SetUp() override {
    model_ = GetParam().make();
    update_masses(model_);
    SplitMix64 random(11);
    const Eigen::Index size = model_.rest_positions.size();
    x_ = model_.rest_positions + make_random_vector(random, size, 0.1);
    v_ = make_random_vector(random, size, 1.0);
  }

  double calc_energy(const System& system, const VecX& x) const {
    return system.calc_energy(EnergyKind::elastic, x) + system.calc_energy(EnergyKind::gravity, x) +
           system.calc_energy(EnergyKind::external, x);
  }

  Model model_;
  VecX x_, v_;
};

constexpr double step = 1e-6;  // m

TEST_P(ForceKit, ConservativeForcesAreTheSlopeOfTheEnergies) {
  const System system(model_);
  VecX f;
  system.calc_conservative(x_, f);
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    VecX plus = x_, minus = x_;
    plus[i] += step;
    minus[i] -= step;
    const double slope = (calc_energy(system, plus) - calc_energy(system, minus)) / (2.0 * step);
    EXPECT_NEAR(f[i], -slope, 1e-7 * GetParam().force);
  }
}

TEST_P(ForceKit, StiffnessMatrixIsTheSlopeOfTheForcesAndSymmetric) {
  const System system(model_);
  const Eigen::MatrixXd K = calc_stiffness(model_, x_);
  EXPECT_LE((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * GetParam().stiffness);
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    VecX plus = x_, minus = x_, f_plus, f_minus;
    plus[i] += step;
    minus[i] -= step;
    system.calc_conservative(plus, f_plus);
    system.calc_conservative(minus, f_minus);
    EXPECT_LE((K.col(i) + (f_plus - f_minus) / (2.0 * step)).cwiseAbs().maxCoeff(), 1e-6 * GetParam().stiffness);
  }
}

TEST_P(ForceKit, ProjectedStiffnessIsPositiveSemidefinite) {
  SplitMix64 random(12);
  for (int k = 0; k < 5; ++k) {
    const VecX x = model_.rest_positions + make_random_vector(random, x_.size(), 0.2 * (k + 1));
    const Eigen::MatrixXd K = calc_stiffness(model_, x, Tangent::positive_semidefinite);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, Eigen::EigenvaluesOnly);
    EXPECT_GE(solver.eigenvalues().minCoeff(), -1e-12 * solver.eigenvalues().maxCoeff());
  }
}

TEST_P(ForceKit, DampingIsItsMatrixTimesTheVelocityAndTakesEnergy) {
  const System system(model_);
  ASSERT_TRUE(system.has_damping());
  BlockMatrix matrix = system.make_matrix();
  matrix.set_zero();
  system.add_damping_matrix(x_, 1.0, matrix);
  const Eigen::MatrixXd D = to_dense(matrix);
  VecX f;
  system.calc_damping(x_, v_, f);
  EXPECT_LE((f + D * v_).cwiseAbs().maxCoeff(), 1e-12 * D.cwiseAbs().maxCoeff());
  EXPECT_LE((D - D.transpose()).cwiseAbs().maxCoeff(), 1e-13 * D.cwiseAbs().maxCoeff());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(D, Eigen::EigenvaluesOnly);
  EXPECT_GE(solver.eigenvalues().minCoeff(), -1e-12 * solver.eigenvalues().maxCoeff());
  VecX both, conservative;
  system.calc_force(x_, v_, both);
  system.calc_conservative(x_, conservative);
  EXPECT_LE((both - conservative - f).cwiseAbs().maxCoeff(), 1e-12 * GetParam().force);
}

TEST_P(ForceKit, PartsOfTheConservativeForceSumUp) {
  const System system(model_);
  VecX dependent, constant, all;
  system.calc_position_dependent(x_, dependent);
  system.calc_constant(constant);
  system.calc_conservative(x_, all);
  EXPECT_LE((dependent + constant - all).cwiseAbs().maxCoeff(), 1e-12 * GetParam().force);
}

TEST_P(ForceKit, ModeBoundIsNotBelowTheLargestFrequencyAndNotFarAbove) {
  const System system(model_);
  const auto bounds = system.calc_mode_bounds();
  ASSERT_EQ(bounds.size(), 1u);
  const VecX roots = system.inverse_masses().cwiseSqrt();
  const Eigen::MatrixXd scaled =
      roots.asDiagonal() * calc_stiffness(model_, model_.rest_positions) * roots.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  const double omega_squared = solver.eigenvalues().maxCoeff();
  EXPECT_GE(bounds[0].omega_squared, omega_squared * (1 - 1e-12));
  EXPECT_LE(bounds[0].omega_squared, omega_squared / 0.09);  // a step of at least 0.3 of the true limit
}

TEST_P(ForceKit, InternalForcesOfAFreeBodyHaveNoSumAndNoTorque) {
  if (GetParam().make == make_everything) return;  // has external forces
  const System system(model_);
  VecX conservative, damping;
  system.calc_conservative(x_, conservative);
  system.calc_damping(x_, v_, damping);
  for (const VecX& f : {conservative, damping}) {
    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    for (std::int64_t i = 0; i < model_.particle_count(); ++i) {
      sum += block3(f, i);
      torque += block3(x_, i).cross(block3(f, i));
    }
    EXPECT_LE(sum.norm(), 1e-12 * GetParam().force);
    if (std::string_view(GetParam().name) != "linear") {
      EXPECT_LE(torque.norm(), 1e-11 * GetParam().force);
    }
  }
}

// Damping inside a body does not slow down its rigid motion.
TEST_P(ForceKit, InternalDampingLeavesRigidMotionAlone) {
  if (GetParam().make == make_everything || std::string_view(GetParam().name) == "linear") return;  // they resist it
  const System system(model_);
  VecX v(x_.size()), f;
  for (std::int64_t i = 0; i < model_.particle_count(); ++i) {
    block3(v, i) = Vec3(3, 2, 1) + Vec3(-1, 0.5, 2).cross(Vec3(block3(x_, i)));
  }
  system.calc_damping(x_, v, f);
  EXPECT_LE(f.cwiseAbs().maxCoeff(), 1e-12 * GetParam().force);
}

INSTANTIATE_TEST_SUITE_P(EveryForce, ForceKit, testing::ValuesIn(scenes()),
                         [](const auto& scene) { return std::string(scene.param.name); });

TEST(System, IdleForcesAddNothing) {
  Model model = make_spring_model({{0, 0, 0}, {1, 0, 0}}, {{0, 1}}, {}, 1.0);
  update_masses(model);
  System system(model);
  EXPECT_FALSE(system.has_damping());
  VecX f;
  system.calc_force(flatten({{0, 0, 0}, {2, 0, 0}}), VecX::Ones(6), f);
  EXPECT_EQ(f, VecX::Zero(6));
  model.gravity = {0, 0, -2};
  model.bodies[0].stiffness = 10.0;
  system.refresh();
  system.calc_force(flatten({{0, 0, 0}, {2, 0, 0}}), VecX::Ones(6), f);
  EXPECT_EQ(f, flatten({{10, 0, -2}, {-10, 0, -2}}));
}

TEST(Model, MassesAreAQuarterOfEachTetrahedronAndOverridesWin) {
  Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}}, {.density = 1200.0});
  model.bodies[0].mass_overrides = {{2, 7.0}, {2, 8.0}};
  update_masses(model);
  EXPECT_DOUBLE_EQ(model.masses[0], 50.0);
  EXPECT_DOUBLE_EQ(model.masses[1], 50.0);
  EXPECT_EQ(model.masses[2], 8.0);
  const Mesh mesh = make_beam({3, 2, 2}, {1.0, 0.5, 0.25});
  Model beam = make_beam_model(mesh, {.density = 800.0});
  update_masses(beam);
  EXPECT_NEAR(beam.masses.sum(), 800.0 * 0.125, 1e-11);
}

}  // namespace
}  // namespace flexcast::test
