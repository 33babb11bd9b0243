// C08, C09, C10, C17: mass and stiffness ratios, steps and springs beyond all measure.
#include <gtest/gtest.h>

#include <complex>
#include <limits>
#include <numbers>

#include "core/integrators/integrator.h"
#include "tests/reference/modes.h"
#include "tests/reference/oscillator.h"
#include "tests/reference/statics.h"
#include "tests/reference/tables.h"

namespace flexcast::test {
namespace {

// Wall - k - m1 - k - m2 with k = 100 N/m, m1 = 1e-3 kg, m2 = 1e3 kg.
Model make_heavy_tail() {
  Model model = make_spring_model({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1}, {1, 2}}, {.stiffness = 100.0}, 1e-3);
  model.bodies[0].mass_overrides = {{2, 1e3}};
  hold(model, [](const Vec3& X) { return X.x() == 0.0; });
  return model;
}

// rad/s, of the axial motion, by the 2 x 2 matrix of masses and forces.
std::pair<double, double> calc_axial_frequencies(const Model& model) {
  const Eigen::SparseMatrix<double> A = make_scaled_stiffness(model, model.rest_positions);
  const double a = A.coeff(0, 0), b = A.coeff(0, 3), c = A.coeff(3, 3);
  const double larger = 0.5 * (a + c) + std::hypot(0.5 * (a - c), b);
  return {std::sqrt((a * c - b * b) / larger), std::sqrt(larger)};
}

TEST(Reference, C08_FrequenciesAtAMassRatioOfAMillionMatch) {
  const auto [slow, fast] = calc_axial_frequencies(make_heavy_tail());
  EXPECT_NEAR(slow, 0.2236067697991275, 1e-9 * 0.2236);
  EXPECT_NEAR(fast, 447.2136514016679, 1e-12 * 447.2);
}

TEST(Reference, C08_AdvertisedStepFollowsTheLightestMass) {
  const Model model = make_heavy_tail();
  const auto simulation =
      make_simulation(model, make_settings("symplectic_euler", 1e-3), make_state(model.rest_positions));
  EXPECT_LE(simulation->calc_stable_step(), 0.00447213539598255);
  EXPECT_GE(simulation->calc_stable_step(), 0.3 * 0.00447213539598255);
}

TEST(Reference, C08_ImplicitMidpointFollowsTheSlowModeWithEitherSolver) {
  for (const char* linear : {"ldlt", "pcg"}) {
    const Model model = make_heavy_tail();
    VecX start = model.rest_positions;
    start[3] += 0.05;  // the slow mode: the light mass hangs in the middle
    start[6] += 0.1;
    Settings settings = make_settings("implicit_midpoint", 0.01);
    settings.solver.linear = linear;
    const auto simulation = make_simulation(model, settings, make_state(start));
    double before = 0.1, first = 0.0, last = 0.0;
    for (int crossings = 0; crossings < 7;) {
      run(*simulation, 1);
      const double now = position(*simulation, 2).x() - 2.0;
      if ((now < 0.0) != (before < 0.0)) {
        last = simulation->state().time - 0.01 * now / (now - before);
        if (crossings++ == 0) first = last;
      }
      before = now;
    }
    EXPECT_NEAR(6.0 * std::numbers::pi / (last - first) / 0.2236067697991275, 1.0, 1e-5) << linear;
  }
}

// Steps of omega dt = 2000 from (x, v / omega) = (start, 0), as complex numbers over the start.
std::vector<std::complex<double>> run_huge_steps(std::string_view integrator, int steps) {
  Oscillator oscillator{.integrator = integrator, .start = 0.1};
  oscillator.step = 2000.0 / oscillator.omega();
  const auto simulation = oscillator.make_simulation();
  std::vector<std::complex<double>> path = {1.0};
  for (int i = 0; i < steps; ++i) {
    run(*simulation, 1);
    path.emplace_back(elongation(*simulation) / 0.1, elongation_rate(*simulation) / oscillator.omega() / 0.1);
  }
  return path;
}

TEST(Reference, C09_BackwardEulerShrinksByItsFactorAtAThousandTimesTheLimit) {
  const auto path = run_huge_steps("backward_euler", 2);
  EXPECT_LE(std::abs(path[1] - std::complex(2.499999375e-07, -4.9999987500e-04)), 1e-13);
  EXPECT_LE(std::abs(path[2] - std::complex(-2.499998125e-07, -2.49999875e-10)), 1e-13);
  EXPECT_NEAR(std::abs(path[1]), 4.99999937500012e-4, 1e-13);
}

// u = x + i v / omega follows u' = -i omega u, so that the steps obey u2 = a u1 + b u0 with complex a and b.
TEST(Reference, C09_Bdf2ShrinksByItsRootsAtAThousandTimesTheLimit) {
  const auto u = run_huge_steps("bdf2", 4);
  const auto determinant = u[1] * u[1] - u[0] * u[2];
  const auto a = (u[2] * u[1] - u[0] * u[3]) / determinant, b = (u[1] * u[3] - u[2] * u[2]) / determinant;
  const auto root = std::sqrt(0.25 * a * a + b);
  const double one = std::abs(0.5 * a + root), other = std::abs(0.5 * a - root);
  EXPECT_NEAR(std::min(one, other), 0.0154618283, 1e-6);
  EXPECT_NEAR(std::max(one, other), 0.0161688465, 1e-6);
}

TEST(Reference, C09_MidpointRingsWithAlternatingSignAtAThousandTimesTheLimit) {
  const auto path = run_huge_steps("implicit_midpoint", 100);
  // -0.999998000002 + 0.001999998 i where y' = i omega y; this one turns the other way.
  const std::complex<double> lambda(-0.999998000002, -0.001999998);
  EXPECT_NEAR(std::abs(lambda), 1.0, 1e-9);
  for (std::size_t n = 1; n < path.size(); ++n) {
    EXPECT_LE(std::abs(path[n] / path[n - 1] - lambda), 1e-8) << n;
    EXPECT_NEAR(std::abs(path[n]), 1.0, 1e-10) << n;
  }
}

TEST(Reference, C09_BackwardEulerOnlyLosesEnergyAndRestsAfterTenHugeSteps) {
  for (const ReferenceLaw& law : reference_laws()) {
    SCOPED_TRACE(law.law);
    const Model model = make_clamped_bar({.cells = {4, 2, 2}, .size = {1.0, 0.5, 0.5}, .elastic = {.law = law.law}});
    VecX start = model.rest_positions;
    for (std::int64_t i = 0; i < model.particle_count(); ++i) {
      const double x = start[3 * i];
      start[3 * i + 1] += 0.2 * x * x;
      start[3 * i] *= 1.0 + 0.1 * x;
    }
    Settings settings = make_settings("symplectic_euler", 1.0);
    settings.time.step = 1000.0 * make_simulation(model, settings, make_state(start))->calc_stable_step();
    settings.time.integrator = "backward_euler";
    const auto simulation = make_simulation(model, settings, make_state(start));
    double energy = calc_energy(*simulation);
    for (int i = 0; i < 10; ++i) {
      run(*simulation, 1);
      EXPECT_LE(calc_energy(*simulation), energy);
      energy = calc_energy(*simulation);
    }
    EXPECT_LE((simulation->state().positions - model.rest_positions).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(Reference, C10_WithoutStiffnessAndDampingParticlesFlyFreely) {
  ASSERT_TRUE(engine_has_integrator("vbd") && engine_has_integrator("xpbd"));
  for (const IntegratorRow& row : integrators()) {
    if (row.name == "quasi_static") continue;
    SCOPED_TRACE(row.name);
    const Model model = make_spring_model({{0, 0, 0}, {1, 0, 0}}, {{0, 1}}, {}, 0.25);
    const VecX v = flatten({{0.5, 0.25, 0}, {-1, 0, 2}});
    const auto simulation =
        make_simulation(model, make_settings(std::string(row.name), 0x1p-6), make_state(model.rest_positions, v));
    run(*simulation, 128);
    EXPECT_EQ(simulation->state().velocities, v);
    EXPECT_LE((simulation->state().positions - model.rest_positions - 2.0 * v).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(Reference, C10_DampingWithoutStiffnessSlowsTheAxialMotionExponentially) {
  Model model = make_spring_model({{0, 0, 0}, {0.5, 0, 0}}, {{0, 1}}, {.damping = 0.2}, 1.0);
  model.bodies[0].mass_overrides = {{1, 3.0}};
  const double start = 0.1, time = 1.0, rate = 0.2 / 0.5 / 0.75;
  const auto simulation = make_simulation(model, make_settings("rk4", 1e-3),
                                          make_state(model.rest_positions, flatten({{0, 0, 0}, {start, 0, 0}})));
  run(*simulation, 1000);
  EXPECT_NEAR(velocity(*simulation, 1).x() - velocity(*simulation, 0).x(), start * std::exp(-rate * time), 1e-12);
}

// 1 kg on a spring with k_s = 1e12 N and r = 1 m.
std::unique_ptr<Simulation> hang_on_steel(std::string_view integrator, double step) {
  return make(concat("name = \"steel\"\ngravity = [0, 0, -9.81]\n", time_table(integrator, step),
                     "[[body]]\nname = \"bob\"\nmodel = \"mass_spring\"\n"
                     "mesh = { shape = \"rope\", cells = [1], size = [1] }\nrotation = [0, ",
                     0.5 * std::numbers::pi,
                     ", 0]\nsprings = { stiffness = 1e12, damping = 0 }\nmass = 1\n"
                     "pin = [ { select = { nodes = [0] } } ]\n"));
}

TEST(Reference, C10_ImplicitSchemesHangAKilogramOnAnAlmostRigidSpring) {
  for (const IntegratorRow& row : integrators()) {
    if (!row.implicit) continue;
    SCOPED_TRACE(row.name);
    const auto simulation = hang_on_steel(row.name, 0.01);
    run(*simulation, 100);
    EXPECT_NEAR((position(*simulation, 1) - position(*simulation, 0)).norm(), 1.0 + 9.81e-12, 1e-9);
    if (row.name != "quasi_static") continue;
    // Doubles near 1 m are 2.2e-16 m apart.
    EXPECT_NEAR((position(*simulation, 1) - position(*simulation, 0)).norm() - 1.0, 9.81e-12, 5e-16);
  }
}

// Runge-Kutta just above its own limit of 2.83e-6 s whirls about, finite; further above it fails like the others.
TEST(Reference, C10_ExplicitSchemesWarnBeforeTheRunAndEndInANamedFailure) {
  for (const IntegratorRow& row : integrators()) {
    if (row.implicit) continue;
    for (const double step : {3e-6, 1e-5, 1e-3}) {
      if (row.name == "rk4" && step < 1e-5) continue;
      SCOPED_TRACE(concat(row.name, " ", step));
      const auto simulation = hang_on_steel(row.name, step);
      EXPECT_LT(simulation->calc_report().stability_margin.value(), 1.0);
      EXPECT_FALSE(simulation->calc_warnings().empty());
      int steps = 0;
      while (simulation->step() && ++steps < 1000000) {
      }
      ASSERT_TRUE(simulation->failure().has_value());
      EXPECT_FALSE(simulation->failure()->cause.empty());
      EXPECT_NE(simulation->failure()->text().find("bob"), std::string::npos) << simulation->failure()->text();
      EXPECT_TRUE(simulation->state().positions.allFinite());
      EXPECT_TRUE(simulation->state().velocities.allFinite());
    }
  }
}

// k1 = 1 N/m and k2 = 1e8 N/m in a row, 1 kg each: stiffness over rest length, 1 N over 1 m and over 1e-8 m.
Model make_stiff_row() {
  Model model = make_spring_model({{-1, 0, 0}, {0, 0, 0}, {1e-8, 0, 0}}, {{0, 1}, {1, 2}}, {.stiffness = 1.0}, 1.0);
  hold(model, [](const Vec3& X) { return X.x() == -1.0; });
  return model;
}

TEST(Reference, C17_SpringsOfStiffnessRatioOneHundredMillionStretchExactly) {
  Model model = make_stiff_row();
  model.external_forces = VecX::Zero(9);
  model.external_forces[6] = 1.0;
  Settings settings = make_settings("quasi_static", 1.0);
  settings.solver.newton_tolerance = 1e-9;
  const auto simulation = make_simulation(model, settings, make_state(model.rest_positions));
  EXPECT_TRUE(solve_static(*simulation));
  const double u1 = displacement(*simulation, 1).x(), u2 = displacement(*simulation, 2).x();
  EXPECT_NEAR(u1, 1.0, 1e-10);
  EXPECT_NEAR(u2, 1.00000001, 1e-10);
  EXPECT_NEAR(u2 - u1, 1e-8, 1e-4 * 1e-8);
}

TEST(Reference, C17_FrequenciesAtAStiffnessRatioOfOneHundredMillionMatch) {
  const auto [slow, fast] = calc_axial_frequencies(make_stiff_row());
  EXPECT_NEAR(slow, 0.707106780302664, 1e-10);
  EXPECT_NEAR(fast, 14142.13564140862, 1e-10 * 14142.0);
}

}  // namespace
}  // namespace flexcast::test
