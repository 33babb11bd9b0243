// A step that would not be finite is refused: the state stays, the reason is told, and the simulation can be revived.
#include <gtest/gtest.h>

#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

using Assignments = std::vector<ParameterAssignment>;

// Two bodies; the second blows up when `step` is far above its limit of about 0.013 s, the first is at rest.
std::string unstable_scene(std::string_view integrator, double step, std::string_view model) {
  const std::string fem = R"(model = "fem"
mesh = { shape = "beam", cells = [2, 1, 1], size = [1.0, 0.5, 0.5] }
material = { law = "corotational", young = 1e6, poisson = 0.3, density = 1000.0 }
)";
  const std::string springs = R"(model = "mass_spring"
mesh = { shape = "lattice", cells = [2, 1, 1], size = [1.0, 0.5, 0.5] }
springs = { stiffness = 1e4, damping = 0.0 }
mass = 0.1
)";
  return concat(
      "name = \"unstable\"\n", time_table(integrator, step),
      "[[body]]\nname = \"calm\"\nmodel = \"mass_spring\"\nmesh = { shape = \"rope\", cells = [3], size = [1] }\n"
      "springs = { stiffness = 1e-9, damping = 0 }\nmass = 1\n[[body]]\nname = \"wild\"\norigin = [0, 5, 0]\n",
      model == "fem" ? fem : springs, "displacement = [ { select = { nodes = [1] }, value = [0.01, 0.02, 0] } ]\n");
}

// Steps until it fails; the state before the failed step.
State run_to_failure(Simulation& simulation) {
  for (int i = 0; i < 100000; ++i) {
    const State before = simulation.state();
    if (simulation.step()) continue;
    EXPECT_EQ(simulation.state().positions, before.positions);
    EXPECT_EQ(simulation.state().velocities, before.velocities);
    EXPECT_EQ(simulation.state().step, before.step);
    EXPECT_EQ(simulation.state().time, before.time);
    return before;
  }
  ADD_FAILURE() << "did not fail";
  return simulation.state();
}

struct Case {
  const char* integrator;
  const char* model;
};

class Failing : public testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<Simulation> make_failing() const {
    return make(unstable_scene(GetParam().integrator, 0.2, GetParam().model));
  }
};

TEST_P(Failing, StepIsRolledBackWithCauseAndPlace) {
  const auto simulation = make_failing();
  const State last = run_to_failure(*simulation);
  ASSERT_TRUE(simulation->failure().has_value());
  const Failure& failure = *simulation->failure();
  EXPECT_TRUE(last.positions.allFinite() && last.velocities.allFinite());
  EXPECT_FALSE(failure.cause.empty());
  EXPECT_FALSE(failure.suggestion.empty());
  EXPECT_EQ(failure.body, "wild");
  EXPECT_TRUE(failure.element >= 0 || failure.particle >= 0);
  EXPECT_LT(failure.particle, 12);
  EXPECT_TRUE(failure.position.allFinite());
  EXPECT_EQ(failure.step, last.step + 1);
  EXPECT_NE(failure.text().find("wild"), std::string::npos) << failure.text();
  EXPECT_TRUE(std::isfinite(simulation->calc_report().kinetic));
}

TEST_P(Failing, FurtherStepsDoNothing) {
  const auto simulation = make_failing();
  run_to_failure(*simulation);
  const std::uint64_t hash = simulation->calc_state_hash();
  const std::int64_t step = simulation->failure()->step;
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(simulation->step());
  EXPECT_EQ(simulation->calc_state_hash(), hash);
  EXPECT_EQ(simulation->failure()->step, step);
}

TEST_P(Failing, ResetRevivesAndFailsAgainAtTheSameStep) {
  const auto simulation = make_failing();
  const State last = run_to_failure(*simulation);
  simulation->reset();
  EXPECT_FALSE(simulation->failure().has_value());
  EXPECT_EQ(simulation->state().step, 0);
  const State again = run_to_failure(*simulation);
  EXPECT_EQ(again.step, last.step);
  EXPECT_EQ(again.positions, last.positions);
}

TEST_P(Failing, AParameterRevivesAfterAResetThatKeepsIt) {
  const auto simulation = make_failing();
  run_to_failure(*simulation);
  ASSERT_TRUE(simulation->set_parameters(Assignments{{"time.step", 1e-4}}).ok());
  EXPECT_FALSE(simulation->failure().has_value());
  simulation->reset(true);
  run(*simulation, 100);
  EXPECT_EQ(simulation->state().time, 100 * 1e-4);
}

TEST_P(Failing, ARefusedBatchDoesNotRevive) {
  const auto simulation = make_failing();
  run_to_failure(*simulation);
  EXPECT_FALSE(simulation->set_parameters(Assignments{{"time.step", -1.0}}).ok());
  EXPECT_TRUE(simulation->failure().has_value());
  EXPECT_FALSE(simulation->step());
}

INSTANTIATE_TEST_SUITE_P(Explicit, Failing,
                         testing::Values(Case{"forward_euler", "fem"}, Case{"symplectic_euler", "fem"},
                                         Case{"velocity_verlet", "fem"}, Case{"rk4", "fem"},
                                         Case{"forward_euler", "springs"}, Case{"symplectic_euler", "springs"},
                                         Case{"velocity_verlet", "springs"}, Case{"rk4", "springs"}),
                         [](const auto& row) { return std::string(row.param.integrator) + "_" + row.param.model; });

TEST(Failure, StateLivesOnAfterASetAlone) {
  const auto simulation = make(unstable_scene("symplectic_euler", 0.2, "springs"));
  // Not yet grown to where no step can be finite.
  run(*simulation, 2);
  ASSERT_TRUE(simulation->set_parameters(Assignments{{"time.integrator", "backward_euler"}}).ok());
  run(*simulation, 50);
  EXPECT_TRUE(simulation->state().positions.allFinite());
}

}  // namespace
}  // namespace flexcast::test
