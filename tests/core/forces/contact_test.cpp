// Contact: the push is the slope of its energy, nothing acts outside, bodies
// come to rest on what they fall on.
#include "core/forces/contact.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "core/integrators/integrator.h"
#include "tests/support/dense.h"
#include "tests/support/model.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

Obstacle make_plane() {
  Obstacle plane;
  plane.name = "plane";
  plane.shape = Obstacle::Shape::plane;
  plane.point = {0.1, 0, 0.2};
  plane.normal = {0.5, -1, 2};
  plane.stiffness = 300.0;
  return plane;
}
Obstacle make_sphere() {
  Obstacle sphere;
  sphere.name = "sphere";
  sphere.shape = Obstacle::Shape::sphere;
  sphere.center = {0.1, 0.2, 0.3};
  sphere.radius = 0.9;
  sphere.stiffness = 200.0;
  return sphere;
}
Obstacle make_box() {
  Obstacle box;
  box.name = "box";
  box.shape = Obstacle::Shape::box;
  box.lo = {-0.5, -0.6, -0.7};
  box.hi = {0.8, 0.9, 0.6};
  box.stiffness = 100.0;
  return box;
}

// Particles that only touch.
Model make_points(std::size_t count, std::vector<Obstacle> obstacles) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(static_cast<double>(i), 0, 0);
  Model model = make_spring_model(points, {}, {}, 0.5);
  model.obstacles = std::move(obstacles);
  update_masses(model);
  return model;
}

TEST(Contact, PushIsTheSlopeOfTheEnergyAndTheTangentTheSlopeOfThePush) {
  constexpr double step = 1e-6;
  for (const Obstacle& obstacle : {make_plane(), make_sphere(), make_box()}) {
    const Model model = make_points(60, {obstacle});
    const System system(model);
    SplitMix64 random(5);
    const VecX x = make_random_vector(random, 180, 1.0);
    VecX f;
    system.calc_conservative(x, f);
    const Eigen::MatrixXd K = calc_stiffness(model, x);
    int touching = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      VecX plus = x, minus = x, f_plus, f_minus;
      plus[i] += step;
      minus[i] -= step;
      const double slope = (system.calc_potential(plus) - system.calc_potential(minus)) / (2 * step);
      EXPECT_NEAR(f[i], -slope, 1e-6) << obstacle.name;
      system.calc_conservative(plus, f_plus);
      system.calc_conservative(minus, f_minus);
      EXPECT_LE((K.col(i) + (f_plus - f_minus) / (2 * step)).cwiseAbs().maxCoeff(), 1e-4) << obstacle.name;
      touching += f[i] != 0.0;
    }
    EXPECT_GT(touching, 10) << obstacle.name;
    EXPECT_LT(touching, 160) << obstacle.name;
  }
}

TEST(Contact, ProjectedTangentIsPositiveSemidefinite) {
  const Model model = make_points(60, {make_plane(), make_sphere(), make_box()});
  SplitMix64 random(6);
  const Eigen::MatrixXd K = calc_stiffness(model, make_random_vector(random, 180, 1.0), Tangent::positive_semidefinite);
  EXPECT_LE((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * 600);
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues().minCoeff(), -1e-12 * 600);
}

TEST(Contact, DoesNothingOutside) {
  SplitMix64 random(7);
  for (const Obstacle& obstacle : {make_plane(), make_sphere(), make_box()}) {
    const Model model = make_points(1, {obstacle});
    const System system(model);
    int outside = 0;
    for (int k = 0; k < 1000; ++k) {
      const Vec3 x = make_random_vector(random, 3.0);
      const bool inside = obstacle.shape == Obstacle::Shape::plane ? obstacle.normal.dot(x - obstacle.point) < 0.0
                          : obstacle.shape == Obstacle::Shape::sphere
                              ? (x - obstacle.center).norm() < obstacle.radius
                              : (x.array() > obstacle.lo.array()).all() && (x.array() < obstacle.hi.array()).all();
      VecX f;
      system.calc_conservative(x, f);
      EXPECT_EQ(f.norm() > 0.0, inside) << obstacle.name;
      EXPECT_EQ(system.calc_energy(EnergyKind::contact, x) > 0.0, inside) << obstacle.name;
      outside += !inside;
    }
    EXPECT_GT(outside, 300);
  }
}

TEST(Contact, DeepInABoxLeavesByTheNearestFace) {
  const Obstacle box = make_box();
  const Model model = make_points(1, {box});
  const System system(model);
  const std::pair<Vec3, Vec3> cases[] = {{{-0.4, 0, 0}, {-10, 0, 0}}, {{0.7, 0, 0}, {10, 0, 0}},
                                         {{0, -0.55, 0}, {0, -5, 0}}, {{0, 0.7, 0}, {0, 20, 0}},
                                         {{0, 0, -0.6}, {0, 0, -10}}, {{0.2, 0.1, 0.5}, {0, 0, 10}}};
  for (const auto& [x, push] : cases) {
    VecX f;
    system.calc_conservative(x, f);
    EXPECT_LE((f - push).norm(), 1e-11);
    Simulation simulation(model, make_settings("symplectic_euler", 1e-3), make_state(x), {});
    run(simulation, 300);
    EXPECT_GT(position(simulation, 0).dot(push.normalized()), 0.6);
  }
}

TEST(Contact, InTheCentreOfASphereStillLeaves) {
  const Obstacle sphere = make_sphere();
  Simulation simulation(make_points(1, {sphere}), make_settings("rk4", 1e-3), make_state(VecX(sphere.center)), {});
  run(simulation, 500);
  EXPECT_GT((position(simulation, 0) - sphere.center).norm(), sphere.radius);
}

// Without weight and elasticity to go by there must be a push all the same.
TEST(Contact, OfTheEnginesOwnStiffnessStopsWhatIsThrown) {
  Obstacle wall = make_plane();
  wall.point = {0, 0, -0.1};
  wall.normal = {0, 0, 1};
  wall.stiffness = 0.0;
  for (const std::size_t particles : {std::size_t{1}, std::size_t{2}}) {
    for (const double weight : {0.0, 9.81}) {
      Model model = make_points(particles, {wall});
      model.gravity = {0, 0, -weight};
      VecX v = VecX::Zero(model.rest_positions.size());
      v[2] = -1.0;
      Simulation simulation(model, make_settings("symplectic_euler", 1e-3), make_state(model.rest_positions, v), {});
      run(simulation, 1000);
      EXPECT_GT(position(simulation, 0).z(), -0.3) << particles << " particles, g = " << weight;
    }
  }
}

TEST(Contact, IsNoForceWhereTheSceneNamesNone) {
  const Model free = make_points(2, {});
  const System none(free);
  EXPECT_TRUE(none.active_forces().empty());
  const Model model = make_points(2, {make_plane()});
  const System system(model);
  ASSERT_EQ(system.active_forces().size(), 1u);
  EXPECT_EQ(system.active_forces()[0]->energy_kind(), EnergyKind::contact);
  EXPECT_FALSE(system.has_friction());
}

// A soft damped cube, its lower face 3 cm above the obstacle.
std::string cube_text(std::string_view scheme, double step, const std::string& obstacle, double friction = 0.0) {
  return concat("name = \"cube\"\ngravity = [0, 0, -9.81]\n", "[time]\nstep = ", step, "\nintegrator = \"", scheme, R"("
[solver]
linear = "ldlt"
newton_tolerance = 1e-8
iterations = 30
[[body]]
name = "cube"
model = "fem"
mesh = { shape = "beam", cells = [2, 2, 2], size = [0.2, 0.2, 0.2] }
material = { law = "corotational", young = 5e4, poisson = 0.3, density = 1000.0 }
damping = { stiffness = 3e-3, mass = 3.0 }
origin = [-0.1, -0.1, 0.03]
[[contact]]
name = "it"
friction = )",
                friction, "\n", obstacle);
}
const std::string ground = "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n";

TEST(Contact, ADroppedCubeComesToRestOnThePlane) {
  for (const char* scheme : {"symplectic_euler", "backward_euler", "vbd"}) {
    const double step = scheme == std::string("symplectic_euler") ? 5e-4 : 2e-3;
    const auto simulation = make(cube_text(scheme, step, ground, 0.3));
    run(*simulation, static_cast<int>(1.5 / step));
    double lowest = 1.0, fastest = 0.0;
    for (std::int64_t i = 0; i < simulation->model().particle_count(); ++i) {
      lowest = std::min(lowest, position(*simulation, i).z());
      fastest = std::max(fastest, velocity(*simulation, i).norm());
    }
    EXPECT_LT(lowest, 0.0) << scheme;
    EXPECT_GT(lowest, -1e-3 * 0.2 * std::sqrt(3.0)) << scheme;
    EXPECT_LT(fastest, 2e-3) << scheme;
  }
}

TEST(Contact, ClosesTheBooksOfABounceWhateverTheScheme) {
  for (const IntegratorRow& row : integrators()) {
    SCOPED_TRACE(row.name);
    const auto simulation = make(cube_text(row.name, 4e-4, ground, 0.4));
    ASSERT_TRUE(simulation->set_parameters(std::vector<ParameterAssignment>{{"gravity", Vec3(3, 0, -9.81)}}).ok());
    const auto calc_balance = [&](const StepReport& r) {
      return r.kinetic + r.elastic + r.gravity + r.contact - r.work + r.dissipated - r.numerical;
    };
    const double start = calc_balance(simulation->calc_report());
    double most = 0.0;
    for (int k = 0; k < 30; ++k) {
      run(*simulation, 10);
      most = std::max(most, simulation->calc_report().contact);
    }
    const StepReport end = simulation->calc_report();
    if (row.name != "quasi_static") {
      EXPECT_GT(most, 0.01);
    }
    EXPECT_NEAR(calc_balance(end), start, 1e-11 * (std::abs(end.gravity) + end.kinetic + end.dissipated + 1.0));
  }
}

TEST(Contact, ACubeSlidesOffASmoothBall) {
  const std::string ball = "shape = \"sphere\"\ncenter = [0, 0, -0.4]\nradius = 0.4\n";
  for (const char* scheme : {"backward_euler", "xpbd"}) {
    const auto simulation = make(cube_text(scheme, 2e-3, ball));
    ASSERT_TRUE(simulation->set_parameters(std::vector<ParameterAssignment>{{"gravity", Vec3(1, 0, -9.81)}}).ok());
    run(*simulation, 750);
    const Vec3 center = simulation->calc_body_reports()[0].center_of_mass;
    EXPECT_LT(center.z(), -1.0) << scheme;
    EXPECT_GT(center.x(), 0.4) << scheme;
    EXPECT_EQ(simulation->calc_report().contact, 0.0) << scheme;
    EXPECT_EQ(simulation->calc_report().inverted, 0) << scheme;
  }
}

}  // namespace
}  // namespace flexcast::test
