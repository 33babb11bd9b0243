// Stretch and stress of particles against values computed by hand.
#include "core/sim/particle_fields.h"

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/state/state.h"
#include "tests/support/model.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

constexpr double young = 2e5, poisson = 0.3;

std::string cube(const std::string& law, const std::string& more = {}) {
  return R"(name = "cube"
[[body]]
name = "cube"
model = "fem"
mesh = { shape = "beam", cells = [3, 2, 2], size = [1.0, 0.5, 0.5] }
material = { law = ")" +
         law + R"(", young = 2e5, poisson = 0.3, density = 1000.0 }
)" + more;
}

VecX map_rest(const Model& model, const Mat3& F) {
  VecX x(model.rest_positions.size());
  for (std::int64_t i = 0; i < model.particle_count(); ++i) block3(x, i) = F * block3(model.rest_positions, i);
  return x;
}

void expect_all_near(const VecX& values, double expected, double tolerance) {
  ASSERT_GT(values.size(), 0);
  for (Eigen::Index i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected, tolerance) << i;
}

struct Fields {
  VecX stretch, stress;
};
Fields calc_fields(const Model& model, const VecX& x) {
  ParticleFields fields(model);
  Fields result;
  fields.calc_stretch(x, result.stretch);
  fields.calc_stress(x, result.stress);
  return result;
}

// A bar drawn by 1 % with the lateral contraction that leaves its sides free: sigma = E eps along it.
TEST(ParticleFields, OfABarInUniaxialStressAreItsStrainAndYoungsModulusTimesIt) {
  const double strain = 0.01;
  const Mat3 F = Vec3(1.0 + strain, 1.0 - poisson * strain, 1.0 - poisson * strain).asDiagonal();
  for (const std::string element : {"tet4", "tet10"}) {
    const auto simulation = make(cube("linear", "element = \"" + element + "\"\n"));
    const Fields fields = calc_fields(simulation->model(), map_rest(simulation->model(), F));
    expect_all_near(fields.stretch, strain, 1e-12);
    expect_all_near(fields.stress, young * strain, 1e-8);
  }
}

// The corotational law has the same P; its Cauchy stress is the force on the area that is left.
TEST(ParticleFields, TakeTheStressOnTheDeformedArea) {
  const double strain = 0.01, side = 1.0 - poisson * strain;
  const Mat3 F = Vec3(1.0 + strain, side, side).asDiagonal();
  const auto simulation = make(cube("corotational"));
  const Fields fields = calc_fields(simulation->model(), map_rest(simulation->model(), F));
  expect_all_near(fields.stress, young * strain / (side * side), 1e-7);
}

TEST(ParticleFields, FeelNoTurn) {
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Mat3 F = R * Vec3(1.2, 0.9, 0.8).asDiagonal();
  for (const char* law : {"corotational", "st_venant_kirchhoff", "neo_hookean"}) {
    const auto simulation = make(cube(law));
    const Model& model = simulation->model();
    const Fields turned = calc_fields(model, map_rest(model, F));
    const Fields straight = calc_fields(model, map_rest(model, Vec3(1.2, 0.9, 0.8).asDiagonal()));
    expect_all_near(turned.stretch, 0.2, 1e-12);
    expect_all_near(turned.stress, straight.stress[0], 1e-6);
    EXPECT_GT(turned.stress[0], 1e4);
  }
}

TEST(ParticleFields, AreZeroAtRest) {
  const auto simulation = make(cube("neo_hookean"));
  const Fields fields = calc_fields(simulation->model(), simulation->model().rest_positions);
  expect_all_near(fields.stretch, 0.0, 1e-15);
  expect_all_near(fields.stress, 0.0, 1e-9);
}

// Two tetrahedra that share a face, one of them twice as high: the shared particles weigh it twice.
TEST(ParticleFields, WeighElementsByTheirRestVolume) {
  const Points rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -2}};
  Model model = make_model(flatten(rest));
  model.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  Body& body = model.bodies[0];
  body.tetrahedra = {0, 2};
  body.law = find_law("linear");
  body.young = young;
  body.poisson = 0.0;
  VecX x = model.rest_positions;
  x[11] = 1.3;   // the upper apex: drawn by 0.3
  x[14] = -2.2;  // the lower one by 0.1
  const Fields fields = calc_fields(model, x);
  const double shared = (0.3 * 1.0 + 0.1 * 2.0) / 3.0;
  for (int i : {0, 1, 2}) EXPECT_NEAR(fields.stretch[i], shared, 1e-14);
  EXPECT_NEAR(fields.stretch[3], 0.3, 1e-14);
  EXPECT_NEAR(fields.stretch[4], 0.1, 1e-14);
  EXPECT_NEAR(fields.stress[0], young * shared, 1e-8);
}

TEST(ParticleFields, OfSpringsAreTheMeanOfTheirStretches) {
  const Points rest = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {9, 9, 9}};
  const Model model = make_spring_model(rest, {{0, 1}, {1, 2}}, {.stiffness = 10.0}, 1.0);
  VecX x = model.rest_positions;
  x[3] = 1.5;
  const Fields fields = calc_fields(model, x);
  EXPECT_NEAR(fields.stretch[0], 0.5, 1e-15);
  EXPECT_NEAR(fields.stretch[1], (0.5 - 0.25) / 2.0, 1e-15);
  EXPECT_NEAR(fields.stretch[2], -0.25, 1e-15);
  EXPECT_EQ(fields.stretch[3], 0.0);  // it has no spring
  EXPECT_EQ(fields.stress, VecX::Zero(4));
}

TEST(ParticleFields, AreFiniteWhereAnElementIsFlat) {
  for (const char* law : {"corotational", "neo_hookean", "linear"}) {
    const auto simulation = make(cube(law));
    const Model& model = simulation->model();
    for (const Mat3& F :
         {Mat3(Vec3(1, 1, 0).asDiagonal()), Mat3(Mat3::Zero()), Mat3(Vec3(1e30, -1e30, 0).asDiagonal())}) {
      const Fields fields = calc_fields(model, map_rest(model, F));
      EXPECT_TRUE(fields.stretch.allFinite() && fields.stress.allFinite()) << law;
      EXPECT_LE(fields.stress.maxCoeff(), largest_magnitude);
    }
  }
}

TEST(ParticleFields, HaveTheSameBitsForAnyNumberOfThreads) {
  const auto simulation = make(cube("neo_hookean", "element = \"tet10\"\n") + "\n");
  const Model& model = simulation->model();
  VecX x = model.rest_positions;
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] *= 1.0 + 0.01 * static_cast<double>(i % 7);
  const Fields one = calc_fields(model, x);
  set_thread_count(3);
  const Fields three = calc_fields(model, x);
  set_thread_count(1);
  EXPECT_EQ(one.stretch, three.stretch);
  EXPECT_EQ(one.stress, three.stress);
}

TEST(ParticleFields, FollowTheLivingParameters) {
  const auto simulation = make(cube("linear"));
  ParticleFields fields(simulation->model());
  const VecX x = map_rest(simulation->model(), Vec3(1.01, 0.997, 0.997).asDiagonal());
  ASSERT_TRUE(simulation->set_parameters(std::vector<ParameterAssignment>{{"cube.young", 4e5}}));
  VecX stress;
  fields.calc_stress(x, stress);
  expect_all_near(stress, 4e5 * 0.01, 1e-7);
}

}  // namespace
}  // namespace flexcast::test
