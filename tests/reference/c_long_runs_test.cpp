// C13, C14: a million steps, and a million metres from the origin.
#include <gtest/gtest.h>

#include "tests/reference/golden_tet.h"
#include "tests/reference/oscillator.h"
#include "tests/reference/tables.h"

namespace flexcast::test {
namespace {

TEST(Reference, C13_SymplecticEulerStaysInItsBandForAMillionSteps) {
  const double h = 0.1;
  Oscillator oscillator;
  const double omega = oscillator.omega();
  oscillator.step = h / omega;
  const auto simulation = oscillator.make_simulation();
  const double start = omega * omega * oscillator.start * oscillator.start;
  double low = 1.0, high = 1.0, drift = 0.0;
  for (int i = 0; i < 1000000; ++i) {
    run(*simulation, 1);
    const double x = elongation(*simulation), v = elongation_rate(*simulation);
    const double twice_energy = v * v + omega * omega * x * x;
    low = std::min(low, twice_energy / start);
    high = std::max(high, twice_energy / start);
    drift = std::max(drift, std::abs((twice_energy - h * omega * x * v) / start - 1.0));
  }
  EXPECT_GE(low, 1.0 / (1.0 + 0.5 * h) - 1e-9);
  EXPECT_LE(high, 1.0 / (1.0 - 0.5 * h) + 1e-9);
  EXPECT_NEAR(low, 1.0 / (1.0 + 0.5 * h), 1e-4);
  EXPECT_NEAR(high, 1.0 / (1.0 - 0.5 * h), 1e-4);
  EXPECT_LE(drift, 1e-11);
}

TEST(Reference, C13_SpinningFreeBodyKeepsItsMomentaForAMillionSteps) {
  for (const char* integrator : {"symplectic_euler", "velocity_verlet"}) {
    SCOPED_TRACE(integrator);
    const Model model = make_beam_model(make_beam({1, 1, 1}, {1.0, 0.5, 0.25}), {.law = "corotational", .young = 1e4});
    VecX v(model.rest_positions.size());
    for (std::int64_t i = 0; i < model.particle_count(); ++i) {
      const Vec3 X = block3(model.rest_positions, i);
      block3(v, i) = Vec3(0.25, -0.5, 0.125) + Vec3(0.1, 0.2, 3.0).cross(X);
    }
    Simulation simulation(model, make_settings(integrator, 1e-3), make_state(model.rest_positions, v), {});
    const StepReport start = simulation.calc_report();
    for (int i = 0; i < 10; ++i) {
      run(simulation, 100000);
      const StepReport now = simulation.calc_report();
      ASSERT_LE((now.momentum - start.momentum).norm(), 1e-10 * start.momentum.norm());
      ASSERT_NEAR(now.angular_momentum.z() / start.angular_momentum.z(), 1.0, 1e-8);
      ASSERT_EQ(now.inverted, 0);
    }
  }
}

TEST(Reference, C14_ForcesFarFromTheOriginAreOnlyRounding) {
  const Vec3 far(1e6, -1e6, 1e6);
  for (const auto& [size, tolerance] : {std::pair{1.0, 1e-5}, {0.01, 1e-6}}) {
    for (const ReferenceLaw& law : reference_laws()) {
      Points rest;
      for (const Vec3& X : golden_points()) rest.emplace_back(size * X);
      const Model model = make_tet_model(rest, {{0, 1, 2, 3}}, {.law = law.law});
      const VecX x = model.rest_positions + far.replicate(4, 1);
      EXPECT_LE(measure_forces(model, x).cwiseAbs().maxCoeff(), tolerance) << law.law << " size " << size;
    }
  }
}

// The rest shape itself there: what matters in a scene.
TEST(Reference, C14_BodiesPlacedFarFromTheOriginStayAtRest) {
  const auto simulation = make("name = \"far\"\n" + time_table("symplectic_euler", 1e-4) +
                               "[[body]]\nname = \"beam\"\nmodel = \"fem\"\n"
                               "mesh = { shape = \"beam\", cells = [2, 1, 1], size = [2, 1, 1] }\n"
                               "material = { law = \"corotational\", young = 1.3e5, poisson = 0.3, density = 1000 }\n"
                               "origin = [1e6, -1e6, 1e6]\n");
  run(*simulation, 1000);
  EXPECT_LE((simulation->state().positions - simulation->model().rest_positions).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace flexcast::test
