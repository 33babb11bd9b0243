// A05, A06: where explicit schemes blow up, and what each scheme does to the energy.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "tests/reference/oscillator.h"
#include "tests/reference/tables.h"

namespace flexcast::test {
namespace {

// The largest elongation during the run over that at the start; stops early at a millionfold.
double calc_growth(Oscillator oscillator, int steps) {
  oscillator.start = 1e-7;  // stays far from a spring of no length even when grown a millionfold
  const auto simulation = oscillator.make_simulation();
  double largest = 0.0;
  for (int i = 0; i < steps && largest <= 1e6; ++i) {
    if (!simulation->step()) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::abs(elongation(*simulation)) / oscillator.start);
  }
  return largest;
}

struct Limit {
  Oscillator oscillator;  // without a step
  double critical_step;   // s, published; digits beyond the published ones from 40-digit arithmetic
};

std::vector<Limit> symplectic_limits() {
  return {{{.damping = 0.0}, 0.06324555320336758664},
          {{.damping = 0.4}, 0.05937191807101943794},
          {{.free_ends = true}, 0.04472135954999579393}};
}

TEST(Reference, A05_SymplecticEulerIsBoundedJustBelowItsLimitAndGrowsJustAbove) {
  for (const Limit& limit : symplectic_limits()) {
    const double zeta = limit.oscillator.zeta();
    SCOPED_TRACE(concat("zeta=", zeta, " free=", limit.oscillator.free_ends));
    EXPECT_NEAR(limit.critical_step, 2.0 * (std::sqrt(1 + zeta * zeta) - zeta) / limit.oscillator.omega(), 1e-15);
    Oscillator oscillator = limit.oscillator;
    oscillator.step = 0.999 * limit.critical_step;
    EXPECT_LT(calc_growth(oscillator, 100000), 1e3);
    oscillator.step = 1.001 * limit.critical_step;
    EXPECT_GT(calc_growth(oscillator, 100000), 1e6);
  }
}

TEST(Reference, A05_VerletAndRungeKuttaAreBoundedJustBelowTheirLimitsAndGrowJustAbove) {
  const double omega = Oscillator{}.omega();
  for (const auto& [integrator, reach] : {std::pair{"velocity_verlet", 2.0}, {"rk4", 2.0 * std::numbers::sqrt2}}) {
    EXPECT_LT(calc_growth({.integrator = integrator, .step = 0.999 * reach / omega}, 100000), 1e3) << integrator;
    EXPECT_GT(calc_growth({.integrator = integrator, .step = 1.001 * reach / omega}, 100000), 1e6) << integrator;
  }
}

TEST(Reference, A05_ForwardEulerNeedsDampingAndGrowsBeyondItsLimit) {
  EXPECT_GT(calc_growth({.integrator = "forward_euler", .step = 1e-3}, 100000), 1e6);
  Oscillator oscillator{.integrator = "forward_euler", .damping = 2.0};
  const double limit = 2.0 * oscillator.zeta() / oscillator.omega();
  oscillator.step = 0.999 * limit;
  EXPECT_LT(calc_growth(oscillator, 100000), 1e3);
  oscillator.step = 1.001 * limit;
  EXPECT_GT(calc_growth(oscillator, 100000), 1e6);
}

TEST(Reference, A05_ImplicitSchemesHaveNoLimit) {
  for (const ReferenceScheme& scheme : reference_schemes()) {
    if (scheme.key != "be" && scheme.key != "im" && scheme.key != "bdf2") continue;
    const Oscillator oscillator{.integrator = scheme.integrator, .step = 1.0};
    EXPECT_LT(calc_growth(oscillator, 2000), 1e3) << scheme.integrator;
    EXPECT_EQ(oscillator.make_simulation()->calc_stable_step(), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(oscillator.make_simulation()->calc_report().stability_margin.has_value());
  }
}

TEST(Reference, A05_AdvertisedStepIsSafeAndUseful) {
  for (const Limit& limit : symplectic_limits()) {
    const double advertised = limit.oscillator.make_simulation()->calc_stable_step();
    EXPECT_LE(advertised, limit.critical_step);
    EXPECT_GE(advertised, 0.3 * limit.critical_step);
  }
  const double omega = Oscillator{}.omega();
  for (const auto& [integrator, reach] : {std::pair{"velocity_verlet", 2.0}, {"rk4", 2.0 * std::numbers::sqrt2}}) {
    const double advertised = Oscillator{.integrator = integrator}.make_simulation()->calc_stable_step();
    EXPECT_LE(advertised, reach / omega) << integrator;
    EXPECT_GE(advertised, 0.3 * reach / omega) << integrator;
  }
  EXPECT_EQ(Oscillator{.integrator = "forward_euler"}.make_simulation()->calc_stable_step(), 0.0);
  const Oscillator damped{.integrator = "forward_euler", .damping = 2.0};
  const double advertised = damped.make_simulation()->calc_stable_step();
  EXPECT_LE(advertised, 2.0 * damped.zeta() / damped.omega());
  EXPECT_GE(advertised, 0.3 * 2.0 * damped.zeta() / damped.omega());
}

TEST(Reference, A05_MarginBelowOneIsAWarningBeforeTheRun) {
  const auto safe = Oscillator{.step = 0.3 * 0.06324555320336758664}.make_simulation();
  EXPECT_TRUE(safe->calc_warnings().empty());
  EXPECT_GE(safe->calc_report().stability_margin.value(), 1.0);
  const auto unsafe = Oscillator{.step = 1.01 * 0.06324555320336758664}.make_simulation();
  EXPECT_FALSE(unsafe->calc_warnings().empty());
  EXPECT_LT(unsafe->calc_report().stability_margin.value(), 1.0);
}

struct EnergyBounds {
  const char* integrator;
  double h;  // omega dt
  double low, high;
};

TEST(Reference, A06_EnergyOfSymplecticSchemesStaysInItsBandAndReachesBothEnds) {
  for (const EnergyBounds& bounds :
       {EnergyBounds{"symplectic_euler", 0.1, 0.952380952380952, 1.052631578947368},
        EnergyBounds{"symplectic_euler", 0.5, 0.8, 4.0 / 3.0}, EnergyBounds{"velocity_verlet", 0.1, 0.9975, 1.0},
        EnergyBounds{"velocity_verlet", 0.5, 0.9375, 1.0}}) {
    SCOPED_TRACE(concat(bounds.integrator, " h=", bounds.h));
    Oscillator oscillator{.integrator = bounds.integrator};
    oscillator.step = bounds.h / oscillator.omega();
    const auto simulation = oscillator.make_simulation();
    const double start = calc_energy(*simulation);
    EXPECT_NEAR(start, 0.25, 1e-14);
    double low = 1.0, high = 1.0;
    for (int i = 0; i < 20000; i += 7) {  // 7 h is no part of a period: all phases come by
      run(*simulation, 7);
      const double ratio = calc_energy(*simulation) / start;
      low = std::min(low, ratio);
      high = std::max(high, ratio);
    }
    EXPECT_GE(low, bounds.low - 1e-9);
    EXPECT_LE(high, bounds.high + 1e-9);
    if (bounds.h < 0.2) {
      EXPECT_NEAR(low, bounds.low, 1e-4);
      EXPECT_NEAR(high, bounds.high, 1e-4);
    }
  }
}

TEST(Reference, A06_SymplecticEulerKeepsItsShadowInvariantForAMillionSteps) {
  const double h = 0.1;
  Oscillator oscillator;
  const double omega = oscillator.omega();
  oscillator.step = h / omega;
  const auto simulation = oscillator.make_simulation();
  const auto calc_invariant = [&] {
    const double x = elongation(*simulation), v = elongation_rate(*simulation);
    return v * v + omega * omega * x * x - h * omega * x * v;
  };
  const double start = calc_invariant();
  for (int i = 0; i < 1000; ++i) {
    run(*simulation, 1000);
    ASSERT_NEAR(calc_invariant() / start, 1.0, 1e-11);
  }
}

TEST(Reference, A06_EnergyChangesByTheClosedFormFactorInEveryStep) {
  for (const double h : {0.1, 0.5}) {
    const double sixth = h * h * h * h * h * h;
    const auto calc_factor = [&](std::string_view key) {
      if (key == "be") return 1.0 / (1.0 + h * h);
      if (key == "fe") return 1.0 + h * h;
      if (key == "rk4") return 1.0 - sixth / 72.0 + sixth * h * h / 576.0;
      return 1.0;  // im
    };
    for (const ReferenceScheme& scheme : reference_schemes()) {
      if (scheme.key == "se" || scheme.key == "vv" || scheme.key == "bdf2") continue;
      SCOPED_TRACE(concat(scheme.integrator, " h=", h));
      Oscillator oscillator{.integrator = scheme.integrator};
      oscillator.step = h / oscillator.omega();
      const auto simulation = oscillator.make_simulation();
      double before = calc_energy(*simulation);
      for (int i = 0; i < 15; ++i) {  // forward Euler must not reach a spring of no length
        run(*simulation, 1);
        const double after = calc_energy(*simulation);
        ASSERT_NEAR(after / before, calc_factor(scheme.key), 1e-9) << "step " << i;
        before = after;
      }
    }
  }
}

}  // namespace
}  // namespace flexcast::test
