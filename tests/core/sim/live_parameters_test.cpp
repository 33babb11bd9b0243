// Parameters that change while a simulation runs.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

using Assignments = std::vector<ParameterAssignment>;

std::string scene_text(std::string_view integrator) {
  return concat("name = \"live\"\ngravity = [0, 0, -9.81]\n", time_table(integrator, 1e-3), R"(
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [3, 1, 1], size = [1.0, 0.3, 0.3] }
material = { law = "corotational", young = 2e4, poisson = 0.3, density = 500.0 }
particle_mass = [ { select = { nodes = [5] }, value = 3.0 } ]
pin = [ { select = { nodes = [0] } }, { select = { nodes = [4] }, axes = "z" } ]
velocity = [ { select = { all = true }, value = [0, 1, 0], spin = [0, 0, 1] } ]
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [4], size = [1.0] }
springs = { stiffness = 30.0, damping = 0.2 }
mass = 0.05
velocity = [ { select = { all = true }, value = [1, 0, 2], spin = [0, 2, 3] } ]
)");
}

const Assignments& all_changes() {
  static const Assignments changes = {{"gravity", Vec3(1, 2, 3)},
                                      {"time.step", 7e-4},
                                      {"time.integrator", "velocity_verlet"},
                                      {"time.integrator", "backward_euler"},
                                      {"time.substeps", std::int64_t{3}},
                                      {"beam.young", 3e4},
                                      {"beam.poisson", 0.1},
                                      {"beam.density", 900.0},
                                      {"beam.damping.stiffness", 1e-3},
                                      {"beam.damping.mass", 0.5},
                                      {"beam.drag", 0.2},
                                      {"rope.stiffness", 55.0},
                                      {"rope.damping", 0.0},
                                      {"rope.mass", 0.2},
                                      {"rope.drag", 0.1},
                                      {"rope.damping.mass", 0.3},
                                      {"solver.linear", "pcg"},
                                      {"solver.linear_tolerance", 1e-8},
                                      {"solver.newton_iterations", std::int64_t{1}},
                                      {"solver.newton_tolerance", 1e-5}};
  return changes;
}

const char* const schemes[] = {"forward_euler", "symplectic_euler", "velocity_verlet", "rk4", "backward_euler"};

TEST(LiveParameters, AChangeEqualsAFreshStartWithTheNewValueToTheBit) {
  for (const char* scheme : schemes) {
    for (const ParameterAssignment& change : all_changes()) {
      SCOPED_TRACE(std::string(scheme) + ": " + change.name + " = " + to_text(change.value));
      const auto live = make(scene_text(scheme));
      run(*live, 20);
      const auto set = live->set_parameters(Assignments{change});
      ASSERT_TRUE(set.ok()) << set.error().message;
      Simulation fresh(live->model(), live->settings(), live->state(), {});
      run(*live, 20);
      run(fresh, 20);
      EXPECT_EQ(live->state().positions, fresh.state().positions);
      EXPECT_EQ(live->state().velocities, fresh.state().velocities);
    }
  }
}

// Changed on the way or given from the start, a value means the same.
TEST(LiveParameters, AChangeBeforeTheFirstStepEqualsASceneWithThatValue) {
  std::string text = scene_text("rk4");
  text.replace(text.find("young = 2e4"), 11, "young = 3e4");
  const auto scene = make(text), live = make(scene_text("rk4"));
  ASSERT_TRUE(live->set_parameters(Assignments{{"beam.young", 3e4}}).ok());
  run(*scene, 20);
  run(*live, 20);
  EXPECT_EQ(live->calc_state_hash(), scene->calc_state_hash());
}

TEST(LiveParameters, AChangeThatIsNoneChangesNothingButTheRevision) {
  for (const char* scheme : schemes) {
    const auto changed = make(scene_text(scheme)), plain = make(scene_text(scheme));
    run(*changed, 20);
    run(*plain, 20);
    for (const ParameterDescriptor& descriptor : changed->parameters()) {
      ASSERT_TRUE(changed->set_parameters(Assignments{{descriptor.name, changed->parameter(descriptor)}}).ok());
    }
    run(*changed, 20);
    run(*plain, 20);
    EXPECT_EQ(changed->calc_state_hash(), plain->calc_state_hash()) << scheme;
    EXPECT_EQ(changed->state().time, plain->state().time);
    EXPECT_GT(changed->parameter_revision(), plain->parameter_revision());
  }
}

TEST(LiveParameters, EveryRowIsReadableAndSettableByName) {
  const auto simulation = make(scene_text("symplectic_euler"));
  EXPECT_EQ(simulation->parameter_revision(), 1u);
  for (const ParameterAssignment& change : all_changes()) {
    const ParameterDescriptor* descriptor = simulation->find_parameter(change.name);
    ASSERT_NE(descriptor, nullptr) << change.name;
    EXPECT_FALSE(descriptor->row->description.empty());
    ASSERT_TRUE(simulation->set_parameters(Assignments{change}).ok()) << change.name;
    EXPECT_EQ(simulation->parameter(*descriptor), change.value) << change.name;
  }
  EXPECT_EQ(simulation->parameter_revision(), 1u + all_changes().size());
  EXPECT_EQ(simulation->find_parameter("beam.stiffness"), nullptr);
  EXPECT_EQ(simulation->find_parameter("rope.young"), nullptr);
}

TEST(LiveParameters, ABatchIsAllOrNothing) {
  const auto simulation = make(scene_text("symplectic_euler"));
  run(*simulation, 5);
  std::vector<ParameterValue> before;
  for (const ParameterDescriptor& descriptor : simulation->parameters())
    before.push_back(simulation->parameter(descriptor));
  Assignments batch = all_changes();
  for (const ParameterAssignment& bad : Assignments{{"beam.young", -1.0},
                                                    {"time.step", 0.0},
                                                    {"rope.young", 1.0},
                                                    {"gravity", "down"},
                                                    {"time.substeps", 2.5}}) {
    for (const bool first : {false, true}) {
      Assignments with_bad = batch;
      with_bad.insert(first ? with_bad.begin() : with_bad.end(), bad);
      const auto result = simulation->set_parameters(with_bad);
      ASSERT_FALSE(result.ok());
      EXPECT_NE(result.error().message.find(bad.name), std::string::npos) << result.error().message;
      for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(simulation->parameter(simulation->parameters()[i]), before[i]);
      }
      EXPECT_EQ(simulation->parameter_revision(), 1u);
    }
  }
}

TEST(LiveParameters, ErrorsNameTheValueAndWhatIsAllowed) {
  const auto simulation = make(scene_text("symplectic_euler"));
  const auto poisson = simulation->set_parameters(Assignments{{"beam.poisson", 0.625}});
  ASSERT_FALSE(poisson.ok());
  EXPECT_NE(poisson.error().message.find("0.625"), std::string::npos) << poisson.error().message;
  EXPECT_NE(poisson.error().message.find("0.5"), std::string::npos) << poisson.error().message;
  const auto integrator = simulation->set_parameters(Assignments{{"time.integrator", "leapfrog"}});
  ASSERT_FALSE(integrator.ok());
  EXPECT_NE(integrator.error().message.find("leapfrog"), std::string::npos) << integrator.error().message;
  EXPECT_NE(integrator.error().message.find("velocity_verlet"), std::string::npos) << integrator.error().message;
}

TEST(LiveParameters, WholeNumbersAndNumbersStandInForEachOther) {
  const auto simulation = make(scene_text("symplectic_euler"));
  ASSERT_TRUE(
      simulation->set_parameters(Assignments{{"beam.young", std::int64_t{30000}}, {"time.substeps", 4.0}}).ok());
  EXPECT_EQ(simulation->model().bodies[0].young, 3e4);
  EXPECT_EQ(simulation->settings().time.substeps, 4);
}

TEST(LiveParameters, DensityKeepsMassOverrides) {
  const auto simulation = make(scene_text("symplectic_euler"));
  const double before = simulation->model().masses[1];
  ASSERT_TRUE(simulation->set_parameters(Assignments{{"beam.density", 1000.0}}).ok());
  EXPECT_DOUBLE_EQ(simulation->model().masses[1], 2.0 * before);
  EXPECT_EQ(simulation->model().masses[5], 3.0);
}

}  // namespace
}  // namespace flexcast::test
