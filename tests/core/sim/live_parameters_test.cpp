// Parameters that change while a simulation runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

using Assignments = std::vector<ParameterAssignment>;

// Steps are a power of two, so that times that are added up are those that are multiplied.
std::string live_scene_text(std::string_view integrator) {
  return concat("name = \"live\"\ngravity = [0, 0, -9.81]\n", time_table(integrator, 0x1p-10), R"(
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
handle = [ { name = "grip", select = { nodes = [2, 3] }, translate = [0, 0, 0.1], rotate = [0.5, 0, 0], duration = 1.0 } ]
[[contact]]
name = "ground"
shape = "plane"
point = [0, 0, 0.01]
normal = [0, 0.1, 1]
friction = 0.3
[[contact]]
name = "ball"
shape = "sphere"
center = [0.5, 0.5, 0.3]
radius = 0.3
[[contact]]
name = "crate"
shape = "box"
lo = [0.9, 0.2, -1]
hi = [2, 2, 2]
)");
}

const Assignments& all_changes() {
  static const Assignments changes = {{"gravity", Vec3(1, 2, 3)},
                                      {"time.step", 7e-4},
                                      {"time.integrator", "velocity_verlet"},
                                      {"time.integrator", "backward_euler"},
                                      {"time.substeps", std::int64_t{3}},
                                      {"time.tolerance", 0.05},
                                      {"time.tolerance", 0.0},
                                      {"time.budget", 0.5},
                                      {"time.error_estimate", "doubling"},
                                      {"beam.law", "linear"},
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
                                      {"solver.newton_tolerance", 1e-5},
                                      {"solver.iterations", std::int64_t{3}},
                                      {"stream.every", std::int64_t{2}},
                                      {"contact.ground.friction", 0.0},
                                      {"contact.ground.stiffness", 2e3},
                                      {"contact.ground.point", Vec3(0, 0, 0.02)},
                                      {"contact.ground.normal", Vec3(0, 0, 3)},
                                      {"contact.ball.friction", 0.6},
                                      {"contact.ball.center", Vec3(0.5, 0.5, 0.25)},
                                      {"contact.ball.radius", 0.35},
                                      {"contact.crate.stiffness", 1e3},
                                      {"contact.crate.lo", Vec3(0.8, 0.1, -1)},
                                      {"contact.crate.hi", Vec3(3, 3, 3)},
                                      {"handle.grip.translate", Vec3(0, 0.1, 0.2)},
                                      {"handle.grip.rotate", Vec3(0, 0.5, 0)},
                                      {"handle.grip.about", Vec3(0.5, 0, 0.1)},
                                      {"handle.grip.start", 0.01},
                                      {"handle.grip.duration", 0.5}};
  return changes;
}

const char* const tried_schemes[] = {"forward_euler", "symplectic_euler", "velocity_verlet", "rk4", "backward_euler"};

TEST(LiveParameters, AChangeEqualsAFreshStartWithTheNewValueToTheBit) {
  for (const char* scheme : tried_schemes) {
    for (const ParameterAssignment& change : all_changes()) {
      SCOPED_TRACE(std::string(scheme) + ": " + change.name + " = " + to_text(change.value));
      const auto live = make(live_scene_text(scheme));
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
  std::string text = live_scene_text("rk4");
  text.replace(text.find("young = 2e4"), 11, "young = 3e4");
  const auto scene = make(text), live = make(live_scene_text("rk4"));
  ASSERT_TRUE(live->set_parameters(Assignments{{"beam.young", 3e4}}).ok());
  run(*scene, 20);
  run(*live, 20);
  EXPECT_EQ(live->calc_state_hash(), scene->calc_state_hash());
}

TEST(LiveParameters, AChangeThatIsNoneChangesNothingButTheRevision) {
  for (const char* scheme : tried_schemes) {
    const auto changed = make(live_scene_text(scheme)), plain = make(live_scene_text(scheme));
    run(*changed, 20);
    run(*plain, 20);
    for (const ParameterDescriptor& descriptor : changed->parameters()) {
      if (!descriptor.row->live) continue;
      ASSERT_TRUE(changed->set_parameters(Assignments{{descriptor.name, changed->parameter(descriptor)}}).ok());
    }
    run(*changed, 20);
    run(*plain, 20);
    EXPECT_EQ(changed->calc_state_hash(), plain->calc_state_hash()) << scheme;
    EXPECT_EQ(changed->state().time, plain->state().time);
    EXPECT_GT(changed->parameter_revision(), plain->parameter_revision());
  }
}

// A row without a change above is a row without a test.
TEST(LiveParameters, EveryLiveRowIsAmongTheChanges) {
  const auto simulation = make(live_scene_text("symplectic_euler"));
  for (const ParameterRow& row : parameter_rows()) {
    const bool tested = std::ranges::any_of(all_changes(), [&](const ParameterAssignment& change) {
      const ParameterDescriptor* descriptor = simulation->find_parameter(change.name);
      return descriptor != nullptr && descriptor->row == &row;
    });
    EXPECT_EQ(tested, row.live) << row.name;
  }
}

TEST(LiveParameters, RowsFixedAtTheStartAreReadAndNotSet) {
  const auto simulation = make(live_scene_text("symplectic_euler"));
  const Assignments values = {{"stream.precision", "float32"}, {"beam.element", "tet4"}};
  for (const ParameterAssignment& assignment : values) {
    const ParameterDescriptor* descriptor = simulation->find_parameter(assignment.name);
    ASSERT_NE(descriptor, nullptr) << assignment.name;
    EXPECT_EQ(simulation->parameter(*descriptor), assignment.value);
    const auto result = simulation->set_parameters(Assignments{assignment});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message, assignment.name + " is fixed when the scene is loaded");
  }
  EXPECT_EQ(simulation->find_parameter("rope.element"), nullptr);
  EXPECT_EQ(simulation->find_parameter("rope.law"), nullptr);
}

TEST(LiveParameters, ObstaclesHaveThoseOfTheirShape) {
  const auto simulation = make(live_scene_text("symplectic_euler"));
  for (const char* name :
       {"contact.ground.normal", "contact.ball.radius", "contact.crate.lo", "contact.crate.friction"})
    EXPECT_NE(simulation->find_parameter(name), nullptr) << name;
  for (const char* name : {"contact.ground.radius", "contact.ball.hi", "contact.crate.normal", "ground.friction"})
    EXPECT_EQ(simulation->find_parameter(name), nullptr) << name;
}

TEST(LiveParameters, TogetherMustMakeAModel) {
  const auto simulation = make(live_scene_text("symplectic_euler"));
  run(*simulation, 5);
  const std::uint64_t hash = simulation->calc_state_hash();
  const std::pair<Assignments, std::string> bad[] = {
      {{{"beam.young", 1.0}, {"contact.ground.normal", Vec3(0, 0, 0)}},
       "contact.ground.normal = [0, 0, 0] is not allowed: expected a vector that is not zero"},
      {{{"contact.crate.lo", Vec3(2, 0.2, -1)}},
       "contact.crate.lo = [2, 0.2, -1] is not allowed: expected less than contact.crate.hi = [2, 2, 2] along every "
       "axis"},
      {{{"contact.crate.hi", Vec3(1, 1, -5)}},
       "contact.crate.lo = [0.9, 0.2, -1] is not allowed: expected less than contact.crate.hi = [1, 1, -5] along every "
       "axis"},
  };
  for (const auto& [batch, message] : bad) {
    const auto result = simulation->set_parameters(batch);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message, message);
    EXPECT_EQ(simulation->model().bodies[0].young, 2e4);
    EXPECT_EQ(simulation->model().obstacles[0].normal, Vec3(0, 0.1, 1));
    EXPECT_EQ(simulation->model().obstacles[2].lo, Vec3(0.9, 0.2, -1));
    EXPECT_EQ(simulation->model().obstacles[2].hi, Vec3(2, 2, 2));
    EXPECT_EQ(simulation->parameter_revision(), 1u);
    EXPECT_EQ(simulation->calc_state_hash(), hash);
  }
  // A box may move as a whole.
  const Assignments moved = {{"contact.crate.lo", Vec3(5, 5, 5)}, {"contact.crate.hi", Vec3(6, 6, 6)}};
  EXPECT_TRUE(simulation->set_parameters(moved).ok());
}

TEST(LiveParameters, EveryRowIsReadableAndSettableByName) {
  const auto simulation = make(live_scene_text("symplectic_euler"));
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
  const auto simulation = make(live_scene_text("symplectic_euler"));
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
  const auto simulation = make(live_scene_text("symplectic_euler"));
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
  const auto simulation = make(live_scene_text("symplectic_euler"));
  ASSERT_TRUE(
      simulation->set_parameters(Assignments{{"beam.young", std::int64_t{30000}}, {"time.substeps", 4.0}}).ok());
  EXPECT_EQ(simulation->model().bodies[0].young, 3e4);
  EXPECT_EQ(simulation->settings().time.substeps, 4);
}

TEST(LiveParameters, DensityKeepsMassOverrides) {
  const auto simulation = make(live_scene_text("symplectic_euler"));
  const double before = simulation->model().masses[1];
  ASSERT_TRUE(simulation->set_parameters(Assignments{{"beam.density", 1000.0}}).ok());
  EXPECT_DOUBLE_EQ(simulation->model().masses[1], 2.0 * before);
  EXPECT_EQ(simulation->model().masses[5], 3.0);
}

}  // namespace
}  // namespace flexcast::test
