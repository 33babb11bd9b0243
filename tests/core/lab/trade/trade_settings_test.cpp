// The settings of a sweep are what was asked for, and what a user would type.
#include "core/lab/trade/trade_settings.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/core/lab/trade/trade_case.h"

namespace flexcast::test {
namespace {

class TradeSettings : public TradeCase {
 protected:
  std::vector<TradeGroup> make() {
    const auto base = load_scene(options_.scene, options_.overrides);
    EXPECT_TRUE(base) << base.error().message;
    auto meshes = make_trade_meshes(options_, base.value());
    EXPECT_TRUE(meshes) << meshes.error().message;
    meshes_ = std::move(meshes).value();
    auto groups = make_trade_groups(options_, base.value(), meshes_.all);
    EXPECT_TRUE(groups) << groups.error().message;
    return std::move(groups).value();
  }
  std::string label(const std::vector<TradeGroup>& groups, std::size_t group, std::size_t step = 0) const {
    return make_setting(groups, group, groups[group].steps[step], meshes_.all, 0.01).label;
  }

  TradeMeshes meshes_;
};

TEST_F(TradeSettings, AreAllIntegratorsButQuasiStaticWithHalvedSteps) {
  write(oscillator_scene);
  const auto groups = make();
  std::set<std::string_view> names;
  for (const TradeGroup& group : groups) {
    names.insert(group.row->name);
    ASSERT_GE(group.steps.size(), 10u) << group.name;
    for (std::size_t i = 1; i < group.steps.size(); ++i)
      EXPECT_EQ(group.steps[i].substeps, 2 * group.steps[i - 1].substeps) << group.name;
  }
  EXPECT_EQ(names.size(), integrators().size() - 1);
  EXPECT_FALSE(names.contains("quasi_static"));
}

// 2 / omega = 0.2 s; the frame is five times as long.
TEST_F(TradeSettings, OfExplicitSchemesBeginWithOneAboveTheStableLimit) {
  write(oscillator_scene);
  options_.overrides = {"time.step=1.0"};
  options_.integrators = {"velocity_verlet", "backward_euler"};
  const auto groups = make();
  EXPECT_TRUE(groups[0].steps[0].above_limit);
  EXPECT_FALSE(groups[0].steps[1].above_limit);
  EXPECT_EQ(groups[0].steps[1].substeps, 6);  // the engine's limit is on the safe side of 5
  EXPECT_FALSE(groups[1].steps[0].above_limit);
  EXPECT_EQ(groups[1].steps[0].substeps, 1);
}

TEST_F(TradeSettings, KeepOneListedStepAboveTheStableLimit) {
  write(oscillator_scene);
  options_.integrators = {"velocity_verlet", "backward_euler"};
  options_.steps = {0.5, 0.4, 0.1, 0.005, 0.005};
  const auto groups = make();
  ASSERT_EQ(groups[0].steps.size(), 3u);
  EXPECT_EQ(groups[0].steps[0].frames, 40);
  EXPECT_TRUE(groups[0].steps[0].above_limit);
  EXPECT_EQ(groups[0].steps[2].substeps, 2);
  EXPECT_EQ(groups[1].steps.size(), 4u);
}

TEST_F(TradeSettings, AreLabelledAsAUserWouldTypeThem) {
  write(oscillator_scene);
  options_.integrators = {"vbd", "backward_euler"};
  options_.iterations = {1, 5};
  options_.steps = {0.02, 0.0025};
  options_.tolerances = {0.01};
  const auto groups = make();
  ASSERT_EQ(groups.size(), 6u);
  EXPECT_EQ(label(groups, 0), "time.integrator=vbd time.step=0.02 time.substeps=1 solver.iterations=1");
  EXPECT_EQ(label(groups, 1, 1), "time.integrator=vbd time.substeps=4 solver.iterations=5");
  EXPECT_EQ(label(groups, 2, 1), "time.integrator=backward_euler time.substeps=4");
  EXPECT_EQ(label(groups, 3, 1), "time.integrator=backward_euler time.substeps=4 solver.newton_iterations=1");
  EXPECT_EQ(label(groups, 5), "time.integrator=backward_euler time.tolerance=0.01");
  EXPECT_EQ(groups[1].name, "vbd, 5 sweeps");
}

TEST_F(TradeSettings, TakeEveryElementAndRefinement) {
  write(linear_scene);
  options_.integrators = {"rk4"};
  options_.elements = {"tet4", "tet10"};
  options_.refinements = {0, 1};
  options_.steps = {0.002};
  const auto groups = make();
  ASSERT_EQ(groups.size(), 4u);
  EXPECT_EQ(label(groups, 3), "time.integrator=rk4 time.substeps=1 block.element=tet10 block.mesh.cells=[4,2,2]");
  EXPECT_EQ(meshes_.finest, 3u);
  EXPECT_EQ(meshes_.base_particles, 12);
  for (const TradeMesh& mesh : meshes_.all) EXPECT_EQ(mesh.compared.size(), 12u) << mesh.name;
  EXPECT_EQ(meshes_.probe_names, std::vector<std::string>{"tip"});
}

TEST_F(TradeSettings, CompareParticlesThatLieInTheSamePlaces) {
  write(linear_scene);
  options_.refinements = {0, 2};
  make();
  std::vector<VecX> rests;
  for (const TradeMesh& mesh : meshes_.all)
    rests.push_back(load_scene(options_.scene, mesh.overrides).value().simulation->model().rest_positions);
  for (std::size_t i = 0; i < meshes_.all[0].compared.size(); ++i) {
    EXPECT_LE((block3(rests[0], meshes_.all[0].compared[i]) - block3(rests[1], meshes_.all[1].compared[i])).norm(),
              1e-12);
  }
}

TEST_F(TradeSettings, RefuseToRefineFilesAndNodeNumbersAndElementsOfSprings) {
  options_.refinements = {1};
  write(oscillator_scene);
  EXPECT_NE(refusal().find("selects nodes by number"), std::string::npos);
  options_.scene = FLEXCAST_SOURCE_DIR "/server/scenes/bunny.toml";
  EXPECT_NE(refusal().find("--refine 1: body \"bunny\" is read from the file"), std::string::npos);
  options_.scene = folder_ / "scene.toml";
  options_.refinements = {};
  options_.elements = {"tet10"};
  EXPECT_NE(refusal().find("--elements tet10: the scene has no body of tetrahedra"), std::string::npos);
}

TEST(TradeStep, IsRoundedToWholeNumbersInAFrameOrOfFrames) {
  EXPECT_EQ(round_step(0.0026, 0.01).substeps, 4);
  EXPECT_EQ(round_step(0.0026, 0.01).frames, 1);
  EXPECT_EQ(round_step(0.027, 0.01).frames, 3);
  EXPECT_EQ(round_step(0.027, 0.01).substeps, 1);
  EXPECT_EQ(calc_common_frames({0.02, 0.03, 0.001}, 0.01), 6);
}

}  // namespace
}  // namespace flexcast::test
