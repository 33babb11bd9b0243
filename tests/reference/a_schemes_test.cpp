// A07, A08: what vertex block descent keeps, and what a changed step costs a scheme of two steps.
#include <gtest/gtest.h>

#include "tests/support/model.h"
#include "tests/support/reference.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

// Two masses of 1 kg and 3 kg on a spring with k_s = 100 N, r = 1 m.
std::unique_ptr<Simulation> make_swept_orbit(std::string_view integrator, double step, double damping = 0.0) {
  Model model = make_spring_model({{0, 0, 0}, {1, 0, 0}}, {{0, 1}}, {.stiffness = 100.0, .damping = damping}, 1.0);
  model.bodies[0].mass_overrides = {{1, 3.0}};
  Settings settings = make_settings(std::string(integrator), step);
  settings.solver.iterations = 60;
  return std::make_unique<Simulation>(
      model, settings, make_state(flatten({{0, 0, 0}, {1.5, 0, 0}}), flatten({{0, 0.5, 0}, {0.2, -1, 0}})),
      std::vector<Probe>{});
}

// Converged, as sixty sweeps make it.
TEST(Reference, A07_SweepsKeepTheMomentumOfAnOrbit) {
  for (const char* integrator : {"vbd", "xpbd"}) {
    for (const double damping : {0.0, 0.7}) {
      SCOPED_TRACE(concat(integrator, " k_d=", damping));
      const auto simulation = make_swept_orbit(integrator, 1e-3, damping);
      const Vec3 start = simulation->calc_report().momentum;
      run(*simulation, 2000);
      EXPECT_LE((simulation->calc_report().momentum - start).norm(), 1e-13 * start.norm());
    }
  }
}

void set_step(Simulation& simulation, double step) {
  const std::vector<ParameterAssignment> assignments = {{"time.step", step}};
  ASSERT_TRUE(simulation.set_parameters(assignments).ok());
}

// Largest difference of a coordinate from x1, y1, x2, y2 at 1 s.
double calc_error_at_one_second(const Simulation& simulation) {
  const Json expected = load_reference("particles.json")["A11_orders"]["ref_y(1s)"];
  EXPECT_NEAR(simulation.state().time, 1.0, 1e-12);
  double error = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 x = position(simulation, static_cast<std::int64_t>(i / 2));
    error = std::max(error, std::abs(x[static_cast<Eigen::Index>(i % 2)] - expected[i].get<double>()));
  }
  return error;
}

TEST(Reference, A08_Bdf2KeepsItsOrderAfterAChangeOfTheStep) {
  std::vector<double> errors;
  for (const double step : {2e-3, 1e-3, 5e-4}) {
    const auto simulation = make_swept_orbit("bdf2", step);
    run(*simulation, std::lround(0.4 / step));
    set_step(*simulation, 0.5 * step);
    run(*simulation, std::lround(0.2 / (0.5 * step)));
    set_step(*simulation, 2.0 * step);
    run(*simulation, std::lround(0.4 / (2.0 * step)));
    errors.push_back(calc_error_at_one_second(*simulation));
  }
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.15);
}

// Every step another length: stale history would show in each of them.
TEST(Reference, A08_Bdf2KeepsItsOrderWhenTheStepChangesAllTheTime) {
  std::vector<double> errors;
  for (const double step : {1e-3, 5e-4, 2.5e-4}) {
    const auto simulation = make_swept_orbit("bdf2", step);
    const int pairs = static_cast<int>(std::lround(1.0 / step / 2.0));
    for (int i = 0; i < pairs; ++i) {
      set_step(*simulation, 0.75 * step);
      run(*simulation, 1);
      set_step(*simulation, 1.25 * step);
      run(*simulation, 1);
    }
    errors.push_back(calc_error_at_one_second(*simulation));
  }
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.15);
}

}  // namespace
}  // namespace flexcast::test
