// Kelvin-Voigt damping of tetrahedra against its formula: the stress F (lambda tr(E') I + 2 mu E') beta with E' the
// rate of the Green strain; for the linear law sym F'.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/support/dense.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

constexpr double beta = 0.02;  // s

Model make_damped(std::string_view law) {
  Model model =
      make_tet_model({{0, 0, 0}, {1.1, 0.1, 0}, {-0.1, 0.9, 0.2}, {0.1, 0, 1.2}}, {{0, 1, 2, 3}}, {.law = law});
  model.bodies[0].stiffness_damping = beta;
  update_masses(model);
  return model;
}

Mat3 calc_edges(const VecX& x) {
  Mat3 edges;
  for (int a = 0; a < 3; ++a) edges.col(a) = block3(x, a + 1) - block3(x, 0);
  return edges;
}

TEST(KelvinVoigt, ForcesFollowTheRateOfStrain) {
  SplitMix64 random(17);
  for (const Law& law : laws()) {
    const Model model = make_damped(law.name);
    const System system(model);
    const Mat3 Dm = calc_edges(model.rest_positions);
    for (int k = 0; k < 10; ++k) {
      const VecX x = model.rest_positions + make_random_vector(random, 12, 0.4);
      const VecX v = make_random_vector(random, 12, 1.0);
      const Mat3 F = calc_edges(x) * Dm.inverse(), rate = calc_edges(v) * Dm.inverse();
      const Mat3 G = law.name == "linear" ? rate : Mat3(F.transpose() * rate);
      const Mat3 strain_rate = 0.5 * (G + G.transpose());
      const Mat3 S = beta * (2.0 * 5e4 * strain_rate + 7.5e4 * strain_rate.trace() * Mat3::Identity());
      const Mat3 P = law.name == "linear" ? S : Mat3(F * S);
      const Mat3 H = -Dm.determinant() / 6.0 * P * Dm.inverse().transpose();  // forces on nodes 1 to 3
      VecX f;
      system.calc_damping(x, v, f);
      for (int a = 0; a < 3; ++a) EXPECT_LE((block3(f, a + 1) - H.col(a)).norm(), 1e-12 * 1.3e5) << law.name;
      EXPECT_LE((block3(f, 0) + H.rowwise().sum()).norm(), 1e-12 * 1.3e5) << law.name;
    }
  }
}

TEST(KelvinVoigt, AtRestItIsTheStiffnessTimesItsTime) {
  for (const Law& law : laws()) {
    const Model model = make_damped(law.name);
    const System system(model);
    BlockMatrix damping = system.make_matrix();
    damping.set_zero();
    system.add_damping_matrix(model.rest_positions, 1.0, damping);
    const Eigen::MatrixXd expected = beta * calc_stiffness(model, model.rest_positions);
    EXPECT_LE((to_dense(damping) - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff()) << law.name;
  }
}

}  // namespace
}  // namespace flexcast::test
