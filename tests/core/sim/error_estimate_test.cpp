// The error that a report gives of its step is about what the step did wrong.
#include <gtest/gtest.h>

#include "core/integrators/integrator.h"
#include "tests/support/smooth.h"

namespace flexcast::test {
namespace {

using Assignments = std::vector<ParameterAssignment>;

// One step from the state of `simulation` done far more finely, by a simulation of the same scene.
VecX calc_true_step(const Simulation& simulation, Simulation& fine) {
  if (!fine.restore(simulation.save()).ok()) throw std::runtime_error("not restored");
  const Assignments finely = {{"time.integrator", std::string("rk4")},
                              {"time.substeps", std::int64_t{200}},
                              {"time.error_estimate", std::string("free")}};
  if (!fine.set_parameters(finely).ok()) throw std::runtime_error("not set");
  run(fine, 1);
  return fine.state().positions;
}

struct Tally {
  int steps = 0, good = 0;
};

// Steps whose estimate is between half and twice the true error.
Tally count_good(const SmoothScene& scene, std::string_view integrator, const std::string& time) {
  const auto simulation = make(scene.text(integrator, time)), fine = make(scene.text(integrator, time));
  Tally tally;
  run(*simulation, 4);
  for (std::int64_t i = 4; i < std::min<std::int64_t>(scene.frames(), 30); ++i) {
    const VecX truth = calc_true_step(*simulation, *fine);
    run(*simulation, 1);
    const double error = calc_rms_distance(simulation->state().positions, truth);
    const auto estimate = simulation->calc_report().error_estimate;
    ++tally.steps;
    tally.good += estimate && *estimate >= 0.5 * error && *estimate <= 2.0 * error;
  }
  return tally;
}

class ErrorEstimateOf : public testing::TestWithParam<std::string> {
 protected:
  void expect_good(const std::string& time) {
    Tally all;
    std::string each;
    for (SmoothScene scene : smooth_scenes()) {
      scene.frame = 0.001;
      scene.duration = 0.1;
      const Tally tally = count_good(scene, GetParam(), time);
      all.steps += tally.steps;
      all.good += tally.good;
      each += concat(" ", scene.name, " ", tally.good, "/", tally.steps);
    }
    EXPECT_GE(all.good, 0.9 * all.steps) << each;
  }
};

using FreeErrorEstimateOf = ErrorEstimateOf;

TEST_P(FreeErrorEstimateOf, IsWithinAFactorOfTwo) {
  expect_good("substeps = 1");
}

INSTANTIATE_TEST_SUITE_P(Schemes, FreeErrorEstimateOf,
                         testing::Values("forward_euler", "symplectic_euler", "velocity_verlet", "backward_euler",
                                         "implicit_midpoint", "bdf2"),
                         [](const auto& of) { return of.param; });

using DoublingOf = ErrorEstimateOf;

TEST_P(DoublingOf, IsWithinAFactorOfTwo) {
  expect_good("substeps = 1\nerror_estimate = \"doubling\"");
}

INSTANTIATE_TEST_SUITE_P(Schemes, DoublingOf,
                         testing::Values("symplectic_euler", "velocity_verlet", "rk4", "backward_euler",
                                         "implicit_midpoint"),
                         [](const auto& of) { return of.param; });

TEST(ErrorEstimate, IsAbsentWhereItWouldCostAndNobodyAsked) {
  const SmoothScene scene = smooth_scenes()[0];
  for (const char* integrator : {"rk4", "xpbd", "vbd", "quasi_static"}) {
    const auto simulation = make(scene.text(integrator, "substeps = 40"));
    run(*simulation, 6);
    EXPECT_FALSE(simulation->calc_report().error_estimate) << integrator;
  }
}

TEST(ErrorEstimate, ByHalfStepsDoesNotChangeTheRun) {
  for (const IntegratorRow& row : integrators()) {
    const SmoothScene scene = smooth_scenes()[1];
    const std::string name(row.name);
    const auto plain = make(scene.text(name, "substeps = 20"));
    const auto doubled = make(scene.text(name, "substeps = 20\nerror_estimate = \"doubling\""));
    run(*plain, 10);
    run(*doubled, 10);
    EXPECT_EQ(plain->calc_state_hash(), doubled->calc_state_hash()) << name;
  }
}

}  // namespace
}  // namespace flexcast::test
