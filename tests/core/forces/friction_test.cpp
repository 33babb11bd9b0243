// Coulomb's friction, for every scheme that has dynamics: what is below the
// cone of friction sticks, what is above slides with the textbook acceleration,
// and what slides stops where the textbook says. The incline is a level plane
// under turned gravity.
#include "core/forces/friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/integrators/integrator.h"
#include "tests/support/model.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

constexpr double g = 9.81, h = 1e-3, stiffness = 2500.0;  // m/s^2, s, N/m
const double size = std::sqrt(2.0);                       // m, of the scene

Vec3 turned_gravity(double angle) {
  return g * Vec3(std::sin(angle), 0, -std::cos(angle));
}

// Four particles of different mass, pressed in as deep as they rest.
Model make_sliders(double friction, const Vec3& gravity) {
  Model model = make_spring_model({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}, {}, 1.0);
  Obstacle plane;
  plane.name = "ground";
  plane.friction = friction;
  plane.stiffness = stiffness;
  model.gravity = gravity;
  for (int i = 0; i < 4; ++i) {
    model.bodies[0].mass_overrides.push_back({i, 0.5 + i});
    model.rest_positions[3 * i + 2] = (0.5 + i) * gravity.z() / stiffness;
  }
  model.obstacles = {plane};
  return model;
}

class FrictionOf : public testing::TestWithParam<IntegratorRow> {
 protected:
  const IntegratorRow& row_ = GetParam();

  Simulation make_run(Model model, const Vec3& velocity) const {
    Settings settings = make_settings(std::string(row_.name), h);
    settings.solver.newton_tolerance = 1e-10;
    settings.solver.iterations = 50;
    VecX v(12);
    for (int i = 0; i < 4; ++i) block3(v, i) = velocity;
    const State start = make_state(model.rest_positions, v);
    return {std::move(model), settings, start, {}};
  }
};

TEST_P(FrictionOf, SticksBelowTheAngleOfFriction) {
  if (row_.name == "quasi_static") return;
  for (const double part : {0.3, 0.95}) {
    const double angle = 0.4;
    Simulation simulation = make_run(make_sliders(std::tan(angle) / part, turned_gravity(angle)), Vec3(0, 0, 0));
    const VecX start = simulation.state().positions;
    run(simulation, 1000);
    const double crept = (simulation.state().positions - start).cwiseAbs().maxCoeff();
    // What is implicit creeps at most at 1e-4 sizes a second; what is explicit
    // does not.
    EXPECT_LE(crept, row_.implicit ? 1e-4 * size : 1e-12);
  }
}

TEST_P(FrictionOf, SlidesAboveTheAngleOfFrictionAsGalileoSays) {
  if (row_.name == "quasi_static") return;
  const double angle = 0.4, mu = 0.2;
  Simulation simulation = make_run(make_sliders(mu, turned_gravity(angle)), Vec3(0, 0, 0));
  const VecX start = simulation.state().positions;
  run(simulation, 1000);
  const double a = g * (std::sin(angle) - mu * std::cos(angle));
  const StepReport report = simulation.calc_report();
  const double friction_work = mu * 8.0 * g * std::cos(angle) * 0.5 * a;
  for (int i = 0; i < 4; ++i) {
    const Vec3 slid = block3(simulation.state().positions, i) - block3(start, i);
    EXPECT_NEAR(slid.x(), 0.5 * a, 0.01 * 0.5 * a) << i;
    EXPECT_NEAR(slid.y(), 0.0, 1e-9) << i;
    EXPECT_NEAR(simulation.state().velocities[3 * i], a, 0.01 * a) << i;
  }
  EXPECT_NEAR(report.dissipated, friction_work, 0.01 * friction_work);
}

TEST_P(FrictionOf, StopsWhatSlidesAfterVSquaredOverTwoMuG) {
  if (row_.name == "quasi_static") return;
  const double mu = 0.3;
  const Vec3 v(1.2, -0.9, 0);
  Simulation simulation = make_run(make_sliders(mu, turned_gravity(0.0)), v);
  const VecX start = simulation.state().positions;
  run(simulation, 800);
  const double way = v.squaredNorm() / (2.0 * mu * g), energy = 0.5 * 8.0 * v.squaredNorm();
  for (int i = 0; i < 4; ++i) {
    const Vec3 slid = block3(simulation.state().positions, i) - block3(start, i);
    EXPECT_LE((slid - way * v.normalized()).norm(), 0.01 * way) << i;
    EXPECT_LE(block3(simulation.state().velocities, i).norm(), row_.implicit ? 1e-4 * size : 1e-9) << i;
  }
  EXPECT_NEAR(simulation.calc_report().dissipated, energy, 0.01 * energy);
}

TEST_P(FrictionOf, OfAnImpactIsItsCoefficientTimesTheNormalImpulse) {
  if (row_.name == "quasi_static") return;
  Model model = make_sliders(0.25, Vec3(0, 0, 0));
  model.obstacles[0].stiffness = 1e3;
  for (int i = 0; i < 4; ++i) {
    model.rest_positions[3 * i + 2] = 0.005;
    model.bodies[0].mass_overrides[static_cast<std::size_t>(i)].value = 1.0;
  }
  Simulation simulation = make_run(model, Vec3(2, 0, -0.5));
  run(simulation, 300);
  for (int i = 0; i < 4; ++i) {
    const Vec3 v = block3(simulation.state().velocities, i);
    EXPECT_GT(v.z(), 0.2);
    EXPECT_NEAR(2.0 - v.x(), 0.25 * (v.z() + 0.5), 0.02 * 0.25) << i;
  }
}

// A soft damped cube instead of particles.
TEST_P(FrictionOf, HoldsASoftBlockToo) {
  if (row_.name == "quasi_static" || row_.name == "forward_euler")
    return;  // the one knows no time, the other no bounds
  const double angle = 0.3;
  for (const double mu : {0.2, 0.4}) {
    Model model = make_beam_model(make_beam({2, 2, 1}, {0.2, 0.2, 0.1}), {.young = 1e5});
    model.bodies[0].stiffness_damping = 4e-3;
    model.gravity = turned_gravity(0.0);
    Obstacle plane;
    plane.name = "ground";
    plane.friction = 1.0;
    model.obstacles = {plane};
    Settings settings = make_settings(std::string(row_.name), 5e-4);
    settings.solver.newton_tolerance = 1e-8;
    settings.solver.iterations = 8;
    Simulation simulation(model, settings, make_state(model.rest_positions), {});
    run(simulation, 600);  // to rest
    const std::vector<ParameterAssignment> tilt = {{"gravity", turned_gravity(angle)}, {"contact.ground.friction", mu}};
    ASSERT_TRUE(simulation.set_parameters(tilt).ok());
    // Once it leans as it will.
    const auto calc_speed = [&] { return simulation.calc_report().momentum.x() / simulation.model().masses.sum(); };
    run(simulation, 400);
    const double start = calc_speed();
    run(simulation, 600);
    const double a = std::max(0.0, g * (std::sin(angle) - mu * std::cos(angle)));
    EXPECT_NEAR((calc_speed() - start) / 0.3, a, mu < 0.3 ? 0.02 * a : 0.01) << mu;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryScheme, FrictionOf, testing::ValuesIn(integrators().begin(), integrators().end()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(FrictionPotential, HasItsForceForSlopeAndItsTangentForSlopeOfThat) {
  SplitMix64 random(3);
  const FrictionPoint point{0, Vec3(1, -2, 0.5).normalized(), 7.0};
  const double slip = 0.2, step = 1e-6;
  for (int k = 0; k < 50; ++k) {
    const Vec3 u = make_random_vector(random, k % 2 ? 0.1 : 1.0);
    const FrictionPotential at = calc_friction_potential(point, slip, u);
    EXPECT_LE(at.gradient.norm(), 7.0 * (1 + 1e-12));
    EXPECT_NEAR(at.gradient.dot(point.normal), 0.0, 1e-12);
    const Mat3 tangent = calc_friction_tangent(point, slip, u);
    for (int axis = 0; axis < 3; ++axis) {
      const FrictionPotential plus = calc_friction_potential(point, slip, u + step * Vec3::Unit(axis));
      const FrictionPotential minus = calc_friction_potential(point, slip, u - step * Vec3::Unit(axis));
      EXPECT_NEAR(at.gradient[axis], (plus.value - minus.value) / (2 * step), 1e-7);
      EXPECT_LE((tangent.col(axis) - (plus.gradient - minus.gradient) / (2 * step)).norm(), 1e-4);
    }
  }
}

}  // namespace
}  // namespace flexcast::test
