// flexcast-lab scene-cost: what is looked at and told. How much anything costs is nobody's promise.
#include "core/lab/cost/scene_cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/lab/cost/scene_cost_report.h"
#include "core/lab/cost/scene_features.h"
#include "core/lab/cost/step_turns.h"
#include "core/lab/options.h"
#include "tests/core/lab/cost/cost_scenes.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

using Json = nlohmann::json;
using Names = std::vector<std::string>;

class LabSceneCost : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::path(testing::TempDir()) /
            (std::string("flexcast_cost_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml");
  }
  void TearDown() override { std::filesystem::remove(path_); }

  int cost(const std::string& scene, const Names& more) {
    std::ofstream(path_) << scene;
    Names arguments = {"scene-cost", path_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    if (std::find(more.begin(), more.end(), "--steps") == more.end())
      arguments.insert(arguments.end(), {"--steps", "20", "--budget", "60"});
    const LabCommand command = parse_lab_command(arguments);
    if (const auto* end = std::get_if<CommandLineEnd>(&command)) return log_ << end->text, end->exit_code;
    SceneCostOptions options = std::get<SceneCostOptions>(command);
    options.stop = &stop_;
    out_.str("");
    return scene_cost_verb(options, out_, log_);
  }
  Json json() const { return Json::parse(out_.str()); }
  Names names(const char* of) const {
    const Json all = json()[of];
    Names names;
    for (const Json& entry : all) names.push_back(entry["name"]);
    return names;
  }

  std::filesystem::path path_;
  std::ostringstream out_, log_;
  std::atomic<bool> stop_ = false;
};

TEST_F(LabSceneCost, LeavesOutEverythingThatTheSceneNames) {
  ASSERT_EQ(cost(everything, {"--json"}), 0) << log_.str();
  EXPECT_EQ(names("features"),
            (Names{"gravity", "damping.mass", "damping.stiffness", "springs.damping", "drag", "force", "surface_force",
                   "contact ground", "friction of ground", "handle grip", "body beam", "body rope"}));
  EXPECT_EQ(names("extras"), (Names{"energies", "probes", "state hash", "bounds", "positions", "stretch"}));
  EXPECT_EQ(json()["steps"], 20);
  EXPECT_EQ(json()["elements"], 12 + 4);
  EXPECT_GT(json()["step_us"], 0.0);
  const Json features = json()["features"];
  for (const Json& feature : features) {
    EXPECT_TRUE(feature["us"].is_number()) << feature;
    EXPECT_GE(feature["spread_us"], json()["noise_us"]);
    EXPECT_EQ(feature["measurable"], std::abs(feature["us"].get<double>()) > feature["spread_us"]);
  }
}

TEST_F(LabSceneCost, NamesNoFeatureOfASceneWithoutAny) {
  ASSERT_EQ(cost(bare("backward_euler"), {"--json"}), 0) << log_.str();
  EXPECT_EQ(names("features"), (Names{"body beam", "body rope"}));
  Names arguments = {"--json"};
  for (const std::string& override : nothing()) arguments.insert(arguments.end(), {"--set", override});
  ASSERT_EQ(cost(bare("backward_euler"), arguments), 0) << log_.str();
  EXPECT_EQ(names("features"), (Names{"body beam", "body rope"}));
}

TEST_F(LabSceneCost, PrintsATableForPeople) {
  ASSERT_EQ(cost(everything, {}), 0) << log_.str();
  for (const char* part :
       {"everything: 16 elements, 17 particles, symplectic_euler, 1 thread, 20 steps of each variant\n", "\n  gravity ",
        "\n  friction of ground ", "\n  body rope ", "\n  state hash ", " of a step"})
    EXPECT_NE(out_.str().find(part), std::string::npos) << part << "\n" << out_.str();
}

// Without damping forward Euler blows up: the cost of damping is that there is a scene at all.
TEST_F(LabSceneCost, SaysWhatCannotBeLeftOut) {
  const std::string scene = R"(name = "pair"
[time]
step = 0.1
integrator = "forward_euler"
[[body]]
name = "pair"
model = "mass_spring"
mesh = { shape = "rope", cells = [1], size = [1.0] }
springs = { stiffness = 30.0, damping = 8.0 }
mass = 1.0
velocity = [ { select = { nodes = [1] }, value = [1e-3, 0.0, 0.0] } ]
)";
  ASSERT_EQ(cost(scene, {"--json", "--steps", "4000"}), 0) << log_.str();
  const Json feature = json()["features"][0];
  EXPECT_EQ(feature["name"], "springs.damping");
  EXPECT_TRUE(feature["us"].is_null());
  EXPECT_FALSE(feature["failure"].get<std::string>().empty());
}

TEST_F(LabSceneCost, EndsWithAnErrorWhenTheSceneFailsOrIsStopped) {
  EXPECT_EQ(cost(everything, {"--set", "time.step=1e3"}), 1);
  EXPECT_EQ(cost("name = 3\n", {}), 1);
  stop_ = true;
  EXPECT_EQ(cost(everything, {}), 1);
  EXPECT_NE(log_.str().find("stopped after"), std::string::npos) << log_.str();
  EXPECT_EQ(out_.str(), "");
}

TEST_F(LabSceneCost, RefusesWrongOptions) {
  for (const Names& wrong :
       std::vector<Names>{{"--steps", "0"}, {"--steps", "9", "--budget", "-1"}, {"--threads", "0"}, {"--csv", "x"}})
    EXPECT_EQ(cost(everything, wrong), 2) << testing::PrintToString(wrong);
}

TEST(SceneCost, ADifferenceWithinTheSpreadIsNotMeasurable) {
  SceneCost cost;
  cost.step_seconds = 1e-3;
  cost.linear_iterations = 12.0;
  cost.features = {{.name = "small", .seconds = 1e-6, .spread = 2e-6, .linear_iterations = 12.0},
                   {.name = "large", .seconds = 4e-5, .spread = 2e-6, .linear_iterations = 6.0},
                   {.name = "saving", .seconds = -4e-5, .spread = 2e-6, .linear_iterations = 12.0}};
  EXPECT_FALSE(cost.features[0].is_measurable());
  EXPECT_TRUE(cost.features[1].is_measurable());
  EXPECT_TRUE(cost.features[2].is_measurable());
  const std::string text = make_scene_cost_text(cost);
  EXPECT_NE(text.find("1.00 us    0.10 %  not measurable: the noise is 2.00 us\n"), std::string::npos) << text;
  EXPECT_NE(text.find("40.0 us    4.00 %  +- 2.00 us; 12 linear iterations, 6 without it\n"), std::string::npos)
      << text;
}

TEST(SceneFeatures, LeaveOutOneThingAndNothingElse) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "flexcast_features.toml";
  std::ofstream(path) << everything;
  const SceneDescription description = describe_scene(path).value();
  std::filesystem::remove(path);
  for (const SceneFeature& feature : list_features(description)) {
    SceneDescription without = description;
    feature.leave_out(without);
    EXPECT_EQ(
        list_features(without).size() + 1 + (feature.name == "contact ground" ? 1 : 0) +  // its friction goes with it
            (feature.name == "body beam" ? 5 : 0) +  // damping of two kinds, load, handle; the other body is alone
            (feature.name == "body rope" ? 4 : 0),
        list_features(description).size())
        << feature.name;
    EXPECT_TRUE(make_simulation(without, ".")) << feature.name;
  }
}

TEST(StepTurns, TakeAsManyStepsOfEachAndTellTheirIterations) {
  std::vector<std::unique_ptr<Simulation>> simulations;
  simulations.push_back(make(bare("backward_euler")));
  simulations.push_back(make(bare("symplectic_euler")));
  int rounds_seen = 0;
  const SteppedTurns turns = step_in_turns(
      simulations, {.steps = 12, .budget = 60.0, .sample = 0.0, .progress = [&](int, int) { ++rounds_seen; }});
  EXPECT_EQ(turns.steps, 12);
  EXPECT_EQ(rounds_seen, 12);
  EXPECT_EQ(simulations[0]->state().step, simulations[1]->state().step);
  EXPECT_EQ(turns.simulations[0].seconds.size(), 12u);
  EXPECT_GE(turns.simulations[0].iterations, 1.0);
  EXPECT_EQ(turns.simulations[1].iterations, 0.0);
}

}  // namespace
}  // namespace flexcast::test
