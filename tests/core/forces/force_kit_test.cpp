// What all forces together must keep: the conservative part is the slope of the energies, the matrices are the slopes
// of the forces, damping takes energy, and inside a free body everything cancels.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <functional>

#include "tests/support/dense.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

struct ForceScene {
  std::string name;
  std::function<Model()> make;
  double force;              // N, what errors are measured against
  double stiffness;          // N/m
  bool isolated = true;      // nothing acts from outside
  bool turns_freely = true;  // a rotation strains nothing
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

Model make_quadratic_only(std::string_view law) {
  Model model = make_quadratic_model(make_beam({2, 1, 1}, {1.0, 0.5, 0.5}), {.law = law, .young = 2e4});
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

std::vector<ForceScene> make_scenes() {
  std::vector<ForceScene> list = {{"springs", make_springs_only, 50.0, 200.0},
                                  {"everything", make_everything, 2e4, 2e4, false, false}};
  for (const Law& law : laws()) {
    const std::string name(law.name);
    list.push_back({name, [name] { return make_tetrahedra_only(name); }, 2e4, 2e4, true, !law.small_strain});
    list.push_back({name + "_tet10", [name] { return make_quadratic_only(name); }, 2e4, 2e4, true, !law.small_strain});
  }
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
  const double power = system.calc_damping(x_, v_, f);
  EXPECT_NEAR(power, -f.dot(v_), 1e-12 * std::abs(power));
  EXPECT_LE((f + D * v_).cwiseAbs().maxCoeff(), 1e-12 * D.cwiseAbs().maxCoeff());
  EXPECT_LE((D - D.transpose()).cwiseAbs().maxCoeff(), 1e-13 * D.cwiseAbs().maxCoeff());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(D, Eigen::EigenvaluesOnly);
  EXPECT_GE(solver.eigenvalues().minCoeff(), -1e-12 * solver.eigenvalues().maxCoeff());
  VecX both, conservative;
  system.calc_force(x_, v_, both);
  system.calc_conservative(x_, conservative);
  EXPECT_LE((both - conservative - f).cwiseAbs().maxCoeff(), 1e-12 * GetParam().force);
}

// Vertex block descent's view: what one particle feels, and how stiffly it is held when the others rest.
TEST_P(ForceKit, BlocksAreTheRowsOfTheForceAndTheDiagonalOfTheMatrices) {
  const System system(model_);
  BlockMatrix stiffness = system.make_matrix(), damping = stiffness;
  system.add_stiffness(x_, 1.0, Tangent::positive_semidefinite, stiffness);
  system.add_damping_matrix(x_, 2.0, damping);
  VecX f, f_damping;
  system.calc_position_dependent(x_, f);
  system.calc_damping(x_, v_, f_damping);

  std::vector<std::int32_t> particles;
  for (std::int32_t i = 0; i < stiffness.rows(); i += 2) particles.push_back(stiffness.rows() - 1 - i);
  std::vector<Vec3> g(particles.size(), Vec3::Zero()), g_damping = g;
  std::vector<Mat3> K(particles.size(), Mat3::Zero()), D = K;
  for (const Force* force : system.active_forces()) {
    if (!force->is_constant()) force->add_blocks(x_, particles, g, K);
    force->add_damping_blocks(x_, v_, 2.0, particles, g_damping, D);
  }
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const std::int32_t i = particles[k];
    EXPECT_LE((g[k] - block3(f, i)).norm(), 1e-12 * GetParam().force);
    EXPECT_LE((g_damping[k] - block3(f_damping, i)).norm(), 1e-12 * GetParam().force);
    EXPECT_LE((K[k] - stiffness.diagonal(i)).cwiseAbs().maxCoeff(), 1e-12 * GetParam().stiffness);
    EXPECT_LE((D[k] - damping.diagonal(i)).cwiseAbs().maxCoeff(), 1e-12 * GetParam().stiffness);
  }
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
  for (const bool held : {false, true}) {
    if (held) std::fill_n(model_.fixed.begin(), 6, std::uint8_t{1});  // two particles, and one axis of a third
    model_.fixed[8] = held ? 1 : 0;
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
}

TEST_P(ForceKit, InternalForcesOfAFreeBodyHaveNoSumAndNoTorque) {
  if (!GetParam().isolated) return;
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
    if (GetParam().turns_freely) {
      EXPECT_LE(torque.norm(), 1e-11 * GetParam().force);
    }
  }
}

// Damping inside a body does not slow down its rigid motion.
TEST_P(ForceKit, InternalDampingLeavesRigidMotionAlone) {
  if (!GetParam().turns_freely) return;
  const System system(model_);
  VecX v(x_.size()), f;
  for (std::int64_t i = 0; i < model_.particle_count(); ++i) {
    block3(v, i) = Vec3(3, 2, 1) + Vec3(-1, 0.5, 2).cross(Vec3(block3(x_, i)));
  }
  system.calc_damping(x_, v, f);
  EXPECT_LE(f.cwiseAbs().maxCoeff(), 1e-12 * GetParam().force);
}

INSTANTIATE_TEST_SUITE_P(EveryForce, ForceKit, testing::ValuesIn(make_scenes()),
                         [](const auto& scene) { return scene.param.name; });

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

TEST(Model, MassesOfQuadraticTetrahedraArePositiveAndSumUpToDensityTimesVolume) {
  Model model = make_quadratic_model({corner_tet(), {{0, 1, 2, 3}}, {}, {}}, {.density = 648.0});
  update_masses(model);  // 108 kg: 3 a corner, 16 a midside node
  for (int corner = 0; corner < 4; ++corner) EXPECT_NEAR(model.masses[corner], 3.0, 1e-13);
  for (int midside = 4; midside < 10; ++midside) EXPECT_NEAR(model.masses[midside], 16.0, 1e-13);
  Model beam = make_quadratic_model(make_beam({3, 2, 2}, {1.0, 0.5, 0.25}), {.density = 800.0});
  update_masses(beam);
  EXPECT_NEAR(beam.masses.sum(), 800.0 * 0.125, 1e-11);
  EXPECT_GT(beam.masses.minCoeff(), 0.0);
}

}  // namespace
}  // namespace flexcast::test
