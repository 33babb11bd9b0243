// flexcast-lab modes and run --static: frequencies one knows, equilibria one knows, and what they print.
#include "core/lab/modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "core/lab/options.h"
#include "core/lab/run.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

using Json = nlohmann::json;

class LabFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) / (std::string("flexcast_") + info->name() + ".toml");
  }
  void TearDown() override { std::filesystem::remove(path_); }

  void write(const std::string& text) const { std::ofstream(path_) << text; }

  Json modes(int count = 6, bool at_equilibrium = false) {
    ModesOptions options{path_, count, at_equilibrium, {}, true, nullptr};
    EXPECT_EQ(modes_verb(options, out_, log_), 0) << log_.str();
    return Json::parse(out_.str());
  }

  std::filesystem::path path_;
  std::ostringstream out_, log_;
};

// A mass of 0.2 kg on a spring of 200 N/m along x.
constexpr const char* oscillator = R"(
name = "oscillator"
[[body]]
name = "pair"
model = "mass_spring"
mesh = { shape = "rope", cells = [1], size = [0.5] }
springs = { stiffness = 100.0 }
mass = 0.2
pin = [ { select = { nodes = [0] } }, { select = { all = true }, axes = "yz" } ]
)";

TEST_F(LabFile, ModesOfAnOscillatorAreTheSquareRootOfStiffnessOverMass) {
  write(oscillator);
  const Json found = modes();
  const double omega = std::sqrt(200.0 / 0.2);
  ASSERT_EQ(found["frequencies"].size(), 1u);
  EXPECT_NEAR(found["frequencies"][0].get<double>(), omega / (2.0 * std::numbers::pi), 1e-12);
  EXPECT_NEAR(found["largest_frequency"].get<double>(), omega / (2.0 * std::numbers::pi), 1e-12);
  EXPECT_NEAR(found["explicit_step"].get<double>(), 2.0 / omega, 1e-14);
}

// Large enough for the iteration (1,764 degrees of freedom): a rigid motion in six ways, then the body's own.
TEST_F(LabFile, ModesOfAFreeBodyBeginWithSixOfFrequencyZero) {
  write(R"(
name = "free"
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [11, 6, 6], size = [1.0, 0.5, 0.4] }
material = { law = "corotational", young = 1e6, poisson = 0.3, density = 1000.0 }
)");
  const Json found = modes(8);
  ASSERT_EQ(found["frequencies"].size(), 8u);
  for (int i = 0; i < 6; ++i) EXPECT_LE(std::abs(found["frequencies"][i].get<double>()), 1e-4);
  EXPECT_GT(found["frequencies"][6].get<double>(), 1.0);
  EXPECT_GE(found["frequencies"][7], found["frequencies"][6]);
  EXPECT_GT(found["largest_frequency"], found["frequencies"][7]);
}

// A string of masses hangs: about its equilibrium the lowest mode is a pendulum's, about its start there is none.
TEST_F(LabFile, ModesAboutTheEquilibriumFeelTheTension) {
  write(R"(
name = "hanging"
gravity = [9.81, 0.0, 0.0]
[[body]]
name = "bob"
model = "mass_spring"
mesh = { shape = "rope", cells = [1], size = [1.0] }
springs = { stiffness = 1e6 }
mass = 1.0
pin = [ { select = { nodes = [0] } } ]
)");
  EXPECT_EQ(modes(1)["frequencies"][0], 0.0);
  out_.str("");
  const double pendulum = std::sqrt(9.81 / (1.0 + 9.81e-6)) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(modes(1, true)["frequencies"][0].get<double>(), pendulum, 1e-6);
}

TEST_F(LabFile, ModesOfASceneThatIsHeldEverywhereAreRefused) {
  write(std::string(oscillator) + "");
  ModesOptions options{path_, 6, false, {"pair.pin=[{ select = { all = true } }]"}, true, nullptr};
  EXPECT_EQ(modes_verb(options, out_, log_), 1);
  EXPECT_NE(log_.str().find("no free particle"), std::string::npos) << log_.str();
}

// A bar of 2 m stretched by a handle: F = E A strain with nu = 0, the torque zero; the other end is pinned.
TEST_F(LabFile, StaticRunReportsWhatAHandleExerts) {
  write(R"(
name = "bar"
[[body]]
name = "bar"
model = "fem"
mesh = { shape = "beam", cells = [4, 1, 1], size = [2.0, 0.1, 0.2] }
material = { law = "corotational", young = 1e6, poisson = 0.0, density = 1000.0 }
pin = [ { select = { box = [[0, 0, 0], [0, 1, 1]] } } ]
handle = [ { name = "grip", select = { box = [[2, 0, 0], [2, 1, 1]] }, translate = [0.02, 0, 0], start = 3.0, duration = 5.0 } ]
)");
  RunOptions options;
  options.scene = path_;
  options.json = options.at_equilibrium = true;
  ASSERT_EQ(run_verb(options, out_, log_), 0) << log_.str();
  const Json result = Json::parse(out_.str());
  EXPECT_EQ(result["state"], "finished");
  EXPECT_EQ(result["integrator"], "quasi_static");
  const Json grip = result["handles"]["grip"];
  EXPECT_NEAR(grip["force"][0].get<double>(), 1e6 * 0.02 * 0.01, 1e-7);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(grip["torque"][axis].get<double>(), 0.0, 1e-7);
  EXPECT_NEAR(result["report"]["elastic"].get<double>(), 0.5 * 1e6 * 0.02 * 0.01 * 0.02, 1e-8);
  EXPECT_NEAR(result["report"]["work"].get<double>(), 0.5 * 1e6 * 0.02 * 0.01 * 0.02, 1e-8);
}

TEST_F(LabFile, StaticRunWithoutAnEquilibriumSaysSoAndFails) {
  write(R"(
name = "falling"
gravity = [0.0, 0.0, -9.81]
[[body]]
name = "pair"
model = "mass_spring"
mesh = { shape = "rope", cells = [1], size = [1.0] }
springs = { stiffness = 10.0 }
mass = 1.0
pin = [ { select = { nodes = [0] }, axes = "xy" } ]
)");
  RunOptions options;
  options.scene = path_;
  options.json = options.at_equilibrium = true;
  EXPECT_EQ(run_verb(options, out_, log_), 1);
  EXPECT_EQ(Json::parse(out_.str())["state"], "failed");
  EXPECT_FALSE(log_.str().empty());
}

TEST_F(LabFile, AnyNumberOfThreadsGivesTheSameBits) {
  std::vector<std::string> hashes;
  for (const char* threads : {"1", "2", "4"}) {
    LabCommand command = parse_lab_command(
        {"run", FLEXCAST_SOURCE_DIR "/server/scenes/cantilever.toml", "--steps", "5", "--threads", threads, "--json"});
    ASSERT_TRUE(std::holds_alternative<RunOptions>(command));
    out_.str("");
    ASSERT_EQ(run_verb(std::get<RunOptions>(command), out_, log_), 0) << log_.str();
    hashes.push_back(Json::parse(out_.str())["state_hash"]);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

}  // namespace
}  // namespace flexcast::test
