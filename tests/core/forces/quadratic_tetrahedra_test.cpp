// What ten-node tetrahedra promise beyond the properties of every force: fields up to degree 2 are represented and
// integrated exactly.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/sim/element_health.h"
#include "tests/support/dense.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

constexpr double young = 1.3e5;  // Pa

Mesh make_irregular_tet() {
  return {{{0, 0, 0}, {1.1, 0.1, 0}, {-0.1, 0.9, 0.2}, {0.1, 0, 1.2}}, {{0, 1, 2, 3}}, {}, {}};
}

// Inner corner nodes out of their places.
Mesh make_irregular_block() {
  Mesh mesh = make_beam({3, 3, 3}, {1.0, 1.0, 1.0});
  SplitMix64 random(5);
  for (Vec3& X : mesh.nodes) {
    if (X.minCoeff() > 0.0 && X.maxCoeff() < 1.0) X += make_random_vector(random, 0.06);
  }
  return mesh;
}

template <class Field>
VecX map_positions(const Model& model, Field field) {
  VecX x(model.rest_positions.size());
  for (std::int64_t i = 0; i < model.particle_count(); ++i) block3(x, i) = field(Vec3(block3(model.rest_positions, i)));
  return x;
}

TEST(QuadraticTetrahedra, ALinearFieldGivesTheSameStressEverywhere) {
  SplitMix64 random(6);
  const Mat3 F = Mat3::Identity() + make_random_matrix(random, 0.2);
  for (const Law& law : laws()) {
    Model model = make_quadratic_model(make_irregular_block(), {.law = law.name, .young = young});
    update_masses(model);
    const System system(model);
    const VecX x = map_positions(model, [&](const Vec3& X) { return Vec3(F * X + Vec3(3, 2, 1)); });
    double Psi = 0.0;
    Mat3 P;
    law.calc_energy(calc_lame(young, 0.3), {&F, 1}, {&Psi, 1});
    law.calc_stress(calc_lame(young, 0.3), {&F, 1}, {&P, 1});
    EXPECT_NEAR(system.calc_energy(EnergyKind::elastic, x), Psi, 1e-12 * young) << law.name;

    VecX f;
    system.calc_conservative(x, f);
    Mat3 virial = Mat3::Zero();  // sum f X^T = -V P
    for (std::int64_t i = 0; i < model.particle_count(); ++i) {
      const Vec3 X = block3(model.rest_positions, i);
      virial += block3(f, i) * X.transpose();
      if (X.minCoeff() > 1e-9 && X.maxCoeff() < 1.0 - 1e-9) {
        EXPECT_LE(block3(f, i).norm(), 1e-12 * young) << law.name;
      }
    }
    EXPECT_LE((virial + P).cwiseAbs().maxCoeff(), 1e-12 * young) << law.name;
  }
}

// Patch test: with the surface moved linearly, the inside follows.
TEST(QuadraticTetrahedra, InsideOfALinearlyMovedSurfaceIsMovedLinearly) {
  const Model model = make_quadratic_model(make_irregular_block(), {.law = "linear", .young = young});
  Mat3 G;
  G << 2, 1, 1, 1, 2, 1, 1, 1, 2;
  const VecX u = map_positions(model, [&](const Vec3& X) { return Vec3(5e-4 * G * X); });
  std::vector<Eigen::Index> inner, outer;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const Vec3 X = block3(model.rest_positions, i / 3);
    (X.minCoeff() > 1e-9 && X.maxCoeff() < 1.0 - 1e-9 ? inner : outer).push_back(i);
  }
  ASSERT_GT(inner.size(), 300u);
  const Eigen::MatrixXd K = calc_stiffness(model, model.rest_positions);
  const VecX solved = K(inner, inner).partialPivLu().solve(-K(inner, outer) * VecX(u(outer)));
  EXPECT_LE((solved - u(inner)).cwiseAbs().maxCoeff(), 1e-12 * u.cwiseAbs().maxCoeff());
}

// u_i = X . A_i X / 2 has the strain e, linear in X, and the integral of a product of linear functions over a
// tetrahedron is V/20 (sum_a p_a q_a + sum_a p_a sum_b q_b) with their values at the corners.
TEST(QuadraticTetrahedra, EnergyOfAQuadraticFieldIsExactForTheLinearLaw) {
  SplitMix64 random(7);
  const Model model = make_quadratic_model(make_irregular_tet(), {.law = "linear", .young = young});
  std::array<Mat3, 3> A;
  for (Mat3& part : A) {
    const Mat3 any = make_random_matrix(random);
    part = any + any.transpose();
  }
  const VecX x = map_positions(model, [&](const Vec3& X) {
    Vec3 u;
    for (int i = 0; i < 3; ++i) u[i] = 0.5 * X.dot(A[i] * X);
    return Vec3(X + u);
  });

  double squares = 0.0, traces = 0.0, trace_sum = 0.0;
  Mat3 sum = Mat3::Zero();
  for (int a = 0; a < 4; ++a) {
    Mat3 gradient;
    for (int i = 0; i < 3; ++i) gradient.row(i) = A[i] * block3(model.rest_positions, a);
    const Mat3 e = 0.5 * (gradient + gradient.transpose());
    squares += e.squaredNorm();
    traces += e.trace() * e.trace();
    sum += e;
    trace_sum += e.trace();
  }
  const Lame elastic = calc_lame(young, 0.3);
  Mat3 edges;
  for (int a = 0; a < 3; ++a) edges.col(a) = block3(model.rest_positions, a + 1) - block3(model.rest_positions, 0);
  const double V = edges.determinant() / 6.0;
  const double energy =
      V / 20.0 * (elastic.mu * (squares + sum.squaredNorm()) + 0.5 * elastic.lambda * (traces + trace_sum * trace_sum));
  Model with_masses = model;
  update_masses(with_masses);
  EXPECT_NEAR(System(with_masses).calc_energy(EnergyKind::elastic, x), energy, 1e-12 * energy);
}

TEST(QuadraticTetrahedra, StiffnessHasExactlySixZeroModes) {
  const Model model = make_quadratic_model(make_irregular_tet(), {.young = young});
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(calc_stiffness(model, model.rest_positions));
  EXPECT_EQ(lu.rank(), 30 - 6);
}

// A midside node pushed along its edge turns a part of the element over while its corners stay.
TEST(QuadraticTetrahedra, HealthIsThatOfTheWorstQuadraturePoint) {
  const Model model = make_quadratic_model(make_irregular_tet(), {});
  const ElementHealth rest = calc_element_health(model, model.bodies[0], model.rest_positions);
  EXPECT_EQ(rest.inverted, 0);
  EXPECT_NEAR(*rest.min_j, 1.0, 1e-14);

  const VecX stretched = map_positions(model, [](const Vec3& X) { return Vec3(2 * X.x(), -0.5 * X.y(), X.z()); });
  const ElementHealth mirrored = calc_element_health(model, model.bodies[0], stretched);
  EXPECT_EQ(mirrored.inverted, 1);
  EXPECT_NEAR(*mirrored.min_j, -1.0, 1e-14);

  VecX bent = model.rest_positions;
  block3(bent, 4) += 0.6 * (block3(bent, 1) - block3(bent, 0));  // of edge 01
  const ElementHealth folded = calc_element_health(model, model.bodies[0], bent);
  EXPECT_EQ(folded.inverted, 1);
  EXPECT_LT(*folded.min_j, -0.05);
}

}  // namespace
}  // namespace flexcast::test
