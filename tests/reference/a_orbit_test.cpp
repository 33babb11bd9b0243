// A07 to A10, A14: springs that turn.
#include <gtest/gtest.h>

#include <map>

#include "tests/reference/tables.h"
#include "tests/support/model.h"
#include "tests/support/reference.h"

namespace flexcast::test {
namespace {

// Two masses of 1 kg and 3 kg on a spring with k_s = 100 N, r = 1 m.
std::unique_ptr<Simulation> make_pair(std::string_view integrator, double step, const Points& positions,
                                      const Points& velocities, double damping = 0.0) {
  Model model = make_spring_model({{0, 0, 0}, {1, 0, 0}}, {{0, 1}}, {.stiffness = 100.0, .damping = damping}, 1.0);
  model.bodies[0].mass_overrides = {{1, 3.0}};
  return std::make_unique<Simulation>(model, make_settings(std::string(integrator), step),
                                      make_state(flatten(positions), flatten(velocities)), std::vector<Probe>{});
}

std::unique_ptr<Simulation> make_orbit(std::string_view integrator, double step, double damping = 0.0) {
  return make_pair(integrator, step, {{0, 0, 0}, {1.5, 0, 0}}, {{0, 0.5, 0}, {0.2, -1, 0}}, damping);
}

// Largest difference of a coordinate from x1, y1, x2, y2.
double calc_position_error(const Simulation& simulation, const Json& expected) {
  double error = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 x = position(simulation, static_cast<std::int64_t>(i / 2));
    error = std::max(error, std::abs(x[static_cast<Eigen::Index>(i % 2)] - expected[i].get<double>()));
  }
  return error;
}

double calc_orbit_error(std::string_view integrator, double step) {
  const auto simulation = make_orbit(integrator, step);
  run(*simulation, std::lround(1.0 / step));
  return calc_position_error(*simulation, load_reference("particles.json")["A11_orders"]["ref_y(1s)"]);
}

TEST(Reference, A07_EverySchemeKeepsTheMomentumOfAnOrbitWithAndWithoutDamping) {
  for (const ReferenceScheme& scheme : reference_schemes()) {
    for (const double damping : {0.0, 0.7}) {
      SCOPED_TRACE(concat(scheme.integrator, " k_d=", damping));
      const auto simulation = make_orbit(scheme.integrator, 1e-3, damping);
      const StepReport start = simulation->calc_report();
      EXPECT_NEAR(start.momentum.x(), 0.6, 1e-15);
      EXPECT_NEAR(start.momentum.y(), -2.5, 1e-15);
      EXPECT_NEAR(start.angular_momentum.z(), -4.5, 1e-14);
      EXPECT_NEAR(start.kinetic + start.elastic, 14.185, 1e-13);
      run(*simulation, 2000);
      const StepReport end = simulation->calc_report();
      EXPECT_LE((end.momentum - start.momentum).norm(), 1e-13 * start.momentum.norm());
    }
  }
}

double calc_angular_drift(std::string_view integrator, double step, double damping) {
  const auto simulation = make_orbit(integrator, step, damping);
  run(*simulation, std::lround(2.0 / step));
  return std::abs(simulation->calc_report().angular_momentum.z() + 4.5) / 4.5;
}

TEST(Reference, A07_SymplecticSchemesKeepTheAngularMomentum) {
  for (const ReferenceScheme& scheme : reference_schemes()) {
    if (scheme.key != "se" && scheme.key != "vv" && scheme.key != "im") continue;
    EXPECT_LE(calc_angular_drift(scheme.integrator, 1e-3, 0.0), 1e-12) << scheme.integrator;
  }
}

// Damping along the velocity instead of along the spring would brake the rotation, whatever the step.
TEST(Reference, A07_DampingAlongTheSpringLeavesTheAngularMomentumAlone) {
  EXPECT_LE(calc_angular_drift("symplectic_euler", 1e-3, 0.7), 1e-12);
  for (const ReferenceScheme& scheme : reference_schemes()) {
    if (scheme.order == 1) continue;
    const double drift = calc_angular_drift(scheme.integrator, 1e-3, 0.7);
    if (scheme.key != "bdf2") {  // loses some in any rotation
      EXPECT_LE(drift, 1e-5) << scheme.integrator;
    }
    EXPECT_LE(calc_angular_drift(scheme.integrator, 5e-4, 0.7), 0.27 * drift + 1e-12) << scheme.integrator;
  }
}

TEST(Reference, A07_OrbitFollowsTheReferenceTrajectory) {
  const Json orbit = load_reference("particles.json");
  const auto simulation = make_orbit("rk4", 2e-4);
  run(*simulation, 5000);
  EXPECT_LE(calc_position_error(*simulation, orbit["A11_orders"]["ref_y(1s)"]), 1e-9);
  run(*simulation, 5000);
  EXPECT_LE(calc_position_error(*simulation, orbit["A10_orbit"]["y(2s)"]), 1e-9);
  EXPECT_NEAR(calc_energy(*simulation), 14.185, 1e-8);
  const Vec3 center = simulation->calc_body_reports().at(0).center_of_mass;
  EXPECT_LE((center - Vec3(1.425, -1.25, 0)).norm(), 1e-12);
}

TEST(Reference, A07_VerletHasThePublishedErrorAndItDividesByFour) {
  const double error = calc_orbit_error("velocity_verlet", 1e-3);
  EXPECT_NEAR(error, 2.117e-5, 0.02 * 2.117e-5);
  EXPECT_NEAR(error / calc_orbit_error("velocity_verlet", 5e-4), 4.0, 0.1);
}

TEST(Reference, A08_EverySchemeConvergesWithItsOrderAndThePublishedErrors) {
  const std::map<int, double> windows = {{1, 0.1}, {2, 0.15}, {4, 0.5}};
  const Json table = load_reference("particles.json")["A11_orders"];
  for (const ReferenceScheme& scheme : reference_schemes()) {
    const Json& row = table[scheme.key == "fe" ? "ee" : std::string(scheme.key)];
    std::vector<double> errors;
    for (std::size_t i = 0; i < row["dt"].size(); ++i) {
      SCOPED_TRACE(concat(scheme.integrator, " dt=", row["dt"][i].get<double>()));
      errors.push_back(calc_orbit_error(scheme.integrator, row["dt"][i]));
      const double published = row["max_pos_err"][i];
      // The reference trajectory itself has eleven digits.
      EXPECT_NEAR(errors.back(), published, 0.02 * published + 1e-10);
      if (i == 0) continue;
      EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), scheme.order, windows.at(scheme.order));
    }
  }
}

// Steady rotation with 4 rad/s about the centre of mass.
std::unique_ptr<Simulation> make_rotor(double damping) {
  const double length = 1.0 / (1.0 - 0.75 * 16.0 / 100.0);
  return make_pair("velocity_verlet", 1e-3, {{-0.75 * length, 0, 0}, {0.25 * length, 0, 0}},
                   {{0, -3.0 * length, 0}, {0, length, 0}}, damping);
}

TEST(Reference, A09_SteadyRotorKeepsItsLengthAlsoWithDamping) {
  for (const double damping : {0.0, 0.5}) {
    const auto simulation = make_rotor(damping);
    EXPECT_NEAR(simulation->calc_report().angular_momentum.z(), 3.87396694214876, 1e-13);
    EXPECT_NEAR(calc_energy(*simulation), 8.67768595041322, 1e-13);
    double deviation = 0.0;
    for (int i = 0; i < 10000; ++i) {
      run(*simulation, 1);
      const double length = (position(*simulation, 1) - position(*simulation, 0)).norm();
      deviation = std::max(deviation, std::abs(length - 1.13636363636364));
    }
    EXPECT_LE(deviation, 1e-5) << "k_d=" << damping;
  }
}

// A mass of 1 kg on a spring with r = 1 m, released horizontally.
std::unique_ptr<Simulation> make_pendulum(std::string_view integrator, double step, double damping = 0.0) {
  return make(concat("name = \"pendulum\"\ngravity = [0, -9.81, 0]\n", time_table(integrator, step),
                     "[[body]]\nname = \"bob\"\nmodel = \"mass_spring\"\n"
                     "mesh = { shape = \"rope\", cells = [1], size = [1] }\n"
                     "springs = { stiffness = 1e4, damping = ",
                     damping, " }\nmass = 1\npin = [ { select = { nodes = [0] } } ]\n"));
}

const Eigen::Vector4d pendulum_at_one_second(-0.98619230516, -0.16857139114, -0.30120846085, 1.7928154714);

double calc_pendulum_error(const Simulation& simulation) {
  Eigen::Vector4d found;
  found << position(simulation, 1).head<2>(), velocity(simulation, 1).head<2>();
  return calc_max_error(found, pendulum_at_one_second);
}

TEST(Reference, A10_StiffPendulumMatchesTheReference) {
  const auto simulation = make_pendulum("rk4", 1e-4);
  run(*simulation, 10000);
  EXPECT_LE(calc_pendulum_error(*simulation), 1e-7);
}

TEST(Reference, A10_BackwardEulerConvergesToThePendulumWithOrderOne) {
  std::vector<double> errors;
  for (const double step : {2e-4, 1e-4, 5e-5}) {
    const auto simulation = make_pendulum("backward_euler", step);
    run(*simulation, std::lround(1.0 / step));
    const Vec3 exact(pendulum_at_one_second[0], pendulum_at_one_second[1], 0.0);
    errors.push_back((position(*simulation, 1) - exact).norm());
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 1.0, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 1.0, 0.1);
}

TEST(Reference, A10_AxialDampingLeavesTheSwingAlone) {
  // k_s = 1e4 N/m and 1 kg: the extension follows the swing within 0.3 %, so hardly anything is dissipated.
  const auto simulation = make_pendulum("rk4", 1e-4, 20.0);
  run(*simulation, 10000);
  const StepReport report = simulation->calc_report();
  EXPECT_NEAR(report.kinetic + report.elastic + report.gravity, 0.0, 0.01 * report.kinetic);
}

TEST(Reference, A14_VerticalBounceFollowsTheCosine) {
  const auto simulation =
      make("name = \"bounce\"\ngravity = [0, -9.81, 0]\n" + time_table("rk4", 1e-4) +
           "[[body]]\nname = \"bob\"\nmodel = \"mass_spring\"\nmesh = { shape = \"rope\", cells = [1], size = [1] }\n"
           "springs = { stiffness = 50, damping = 0 }\nmass = 0.5\nrotation = [0, 0, -1.5707963267948966]\n"
           "pin = [ { select = { nodes = [0] } } ]\n");
  const double middle = 1.0981, amplitude = 0.0981;
  double longest = 0.0;
  for (int i = 1; i <= 10000; ++i) {
    run(*simulation, 1);
    const double length = -position(*simulation, 1).y();
    longest = std::max(longest, length);
    ASSERT_NEAR(length, middle - amplitude * std::cos(10.0 * 1e-4 * i), 1e-9);
  }
  EXPECT_NEAR(longest, 1.1962, 1e-6);
  EXPECT_NEAR(position(*simulation, 1).y(), -1.1804129170024, 1e-9);
}

}  // namespace
}  // namespace flexcast::test
