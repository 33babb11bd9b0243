// A01, A03, A04: one-dimensional motions whose discrete solutions are known in closed form.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/reference/oscillator.h"
#include "tests/reference/tables.h"
#include "tests/support/reference.h"

namespace flexcast::test {
namespace {

// y(t) - exact for a fall from rest, m: elementary difference equations.
double calc_fall_error(std::string_view integrator, double gravity, double time, double step) {
  if (integrator == "forward_euler") return 0.5 * gravity * time * step;
  if (integrator == "symplectic_euler" || integrator == "backward_euler") return -0.5 * gravity * time * step;
  if (integrator == "bdf2") return -0.75 * gravity * step * step * (1.0 - std::pow(3.0, -time / step));
  return 0.0;
}

std::string falling_spring(std::string_view name, double mass) {
  return concat("[[body]]\nname = \"", name,
                "\"\nmodel = \"mass_spring\"\n"
                "mesh = { shape = \"rope\", cells = [1], size = [1.0] }\n"
                "springs = { stiffness = 10.0, damping = 0.0 }\nmass = ",
                mass, "\norigin = [0, 100, 0]\n");
}

TEST(Reference, A01_FreeFallHasTheClosedFormErrorOfEverySchemeWhateverTheMass) {
  const std::string cube =
      "[[body]]\nname = \"cube\"\nmodel = \"fem\"\nmesh = { shape = \"beam\", cells = [1, 1, 1], size = [1, 1, 1] }\n"
      "material = { law = \"corotational\", young = 100.0, poisson = 0.3, density = 1000.0 }\norigin = [0, 100, 0]\n";
  for (const ReferenceScheme& scheme : reference_schemes()) {
    SCOPED_TRACE(scheme.integrator);
    const auto simulation = make("name = \"fall\"\ngravity = [0, -9.81, 0]\n" + time_table(scheme.integrator, 0.01) +
                                 falling_spring("light", 1e-3) + falling_spring("heavy", 1e3) + cube);
    const VecX start = simulation->state().positions;
    run(*simulation, 200);
    const double expected = -0.5 * 9.81 * 4.0 + calc_fall_error(scheme.integrator, 9.81, 2.0, 0.01);
    for (std::int64_t i = 0; i < simulation->model().particle_count(); ++i) {
      EXPECT_NEAR(position(*simulation, i).y() - block3(start, i).y(), expected, 1e-11) << "particle " << i;
    }
  }
}

TEST(Reference, A03_OscillatorMatchesTheDiscreteSolutionOfEveryScheme) {
  const Json table = load_reference("particles.json")["A2_spring"];
  for (const ReferenceScheme& scheme : reference_schemes()) {
    const std::string key = scheme.key == "bdf2" ? "bdf2_BEstart" : std::string(scheme.key);
    for (const auto& [name, step] : {std::pair{"0.001", 1e-3}, {"0.0005", 5e-4}, {"0.00025", 2.5e-4}}) {
      SCOPED_TRACE(concat(scheme.integrator, " dt=", step));
      const auto simulation = Oscillator{.integrator = scheme.integrator, .step = step}.make_simulation();
      run(*simulation, std::lround(1.0 / step));
      const Json& expected = table[std::string("discrete_x_v_at_1s_dt") + name][key];
      EXPECT_NEAR(elongation(*simulation), expected[0].get<double>(), 1e-10);
      EXPECT_NEAR(elongation_rate(*simulation), expected[1].get<double>(), 1e-10);
    }
  }
}

TEST(Reference, A03_OscillatorPeriodIsThatOfStiffnessOverRestLength) {
  const Oscillator oscillator{.integrator = "rk4", .step = 1e-4};
  EXPECT_NEAR(oscillator.omega(), 31.6227766016838, 1e-12);
  const auto simulation = oscillator.make_simulation();
  run(*simulation, 10000);
  EXPECT_NEAR(elongation(*simulation), 0.0489341348279946, 1e-10);
  EXPECT_NEAR(elongation_rate(*simulation), -0.324731348403020, 1e-8);
}

TEST(Reference, A04_DampedOscillatorMatchesTheExactSolution) {
  const Oscillator oscillator{.integrator = "rk4", .step = 1e-4, .damping = 0.4};
  EXPECT_NEAR(oscillator.zeta(), 0.0632455532033676, 1e-15);
  EXPECT_NEAR(calc_exact_elongation(oscillator, 0.3), -0.0274900045515500, 1e-15);
  const auto simulation = oscillator.make_simulation();
  run(*simulation, 3000);
  EXPECT_NEAR(elongation(*simulation), -0.0274900045515500, 1e-9);
}

TEST(Reference, A04_LogarithmicDecrementIsThatOfTheDampingOverRestLength) {
  const auto simulation = Oscillator{.integrator = "rk4", .step = 1e-5, .damping = 0.4}.make_simulation();
  // Peaks are where the velocity changes sign from positive to negative; cubic Hermite there is beyond 1e-9.
  std::vector<double> peaks;
  for (int i = 0; i < 60000 && peaks.size() < 2; ++i) {
    const double rate = elongation_rate(*simulation);
    const double x = elongation(*simulation);
    run(*simulation, 1);
    const double next_rate = elongation_rate(*simulation);
    if (rate <= 0.0 || next_rate > 0.0) continue;
    const double s = rate / (rate - next_rate);
    const double next_x = elongation(*simulation);
    const double h00 = 1 + s * s * (2 * s - 3), h10 = s * (1 - s) * (1 - s), h11 = s * s * (s - 1);
    peaks.push_back(h00 * x + (1 - h00) * next_x + 1e-5 * (h10 * rate + h11 * next_rate));
  }
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_NEAR(std::log(peaks[0] / peaks[1]), 0.398180689969879, 1e-8);
}

TEST(Reference, A04_TwoFreeMassesOscillateWithTheReducedMass) {
  const Oscillator oscillator{.integrator = "rk4", .step = 1e-4, .damping = 0.4, .free_ends = true};
  const auto simulation = oscillator.make_simulation();
  run(*simulation, 3000);
  EXPECT_NEAR(elongation(*simulation), calc_exact_elongation(oscillator, 0.3), 1e-9);
}

TEST(Reference, A04_CriticalDampingIsWhereTheOvershootEnds) {
  const double critical = 6.32455532033676;
  for (const double factor : {0.98, 1.0, 1.02}) {
    const auto simulation =
        Oscillator{.integrator = "rk4", .step = 1e-4, .damping = factor * critical}.make_simulation();
    double lowest = 0.0;
    // Below critical damping the first overshoot comes at pi / omega_d: 0.5 s at a factor of 0.98.
    for (int i = 0; i < 8000; ++i) {
      run(*simulation, 1);
      lowest = std::min(lowest, elongation(*simulation));
    }
    if (factor < 1.0) {
      EXPECT_LT(lowest, -1e-10) << factor;
    } else {
      EXPECT_GE(lowest, -1e-14) << factor;
    }
  }
}

TEST(Reference, A04_ErrorsOfFirstOrderSchemesHalveWithTheStep) {
  for (const ReferenceScheme& scheme : reference_schemes()) {
    if (scheme.order != 1) continue;
    std::vector<double> errors;
    for (const double step : {5e-4, 2.5e-4}) {
      const Oscillator oscillator{.integrator = scheme.integrator, .step = step, .damping = 0.4};
      const auto simulation = oscillator.make_simulation();
      run(*simulation, std::lround(0.3 / step));
      errors.push_back(std::abs(elongation(*simulation) - calc_exact_elongation(oscillator, 0.3)));
    }
    EXPECT_NEAR(errors[0] / errors[1], 2.0, 0.1) << scheme.integrator;
  }
}

}  // namespace
}  // namespace flexcast::test
