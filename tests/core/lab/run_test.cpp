// flexcast-lab run: the report, the frames and the files are those of the simulation.
#include "core/lab/run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace flexcast::test {
namespace {

using Json = nlohmann::json;

class LabRun : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("flexcast_lab_") + info->name());
    std::filesystem::create_directories(folder_);
    options_.scene = FLEXCAST_SOURCE_DIR "/server/scenes/pendulum.toml";
    options_.json = true;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  int run() {
    out_.str("");
    log_.str("");
    return run_verb(options_, out_, log_);
  }
  Json json() const { return Json::parse(out_.str()); }

  static std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  std::filesystem::path folder_;
  RunOptions options_;
  std::ostringstream out_, log_;
};

TEST_F(LabRun, PrintsTheDocumentedObject) {
  options_.steps = 10;
  ASSERT_EQ(run(), 0) << log_.str();
  const auto keys_of = [](const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;  // in alphabetical order
  };
  const Json result = json();
  EXPECT_EQ(keys_of(result),
            (std::vector<std::string>{"bodies", "handles", "integrator", "probes", "report", "scene", "state",
                                      "state_hash", "steps", "substeps", "time", "wall_seconds", "warnings"}));
  EXPECT_EQ(
      keys_of(result["report"]),
      (std::vector<std::string>{"angular_momentum", "contact", "converged", "dissipated", "elastic", "error_estimate",
                                "gravity", "inverted", "iterations", "kinetic", "linear_iterations", "min_j",
                                "momentum", "numerical", "residual", "stability_margin", "substeps", "work"}));
  EXPECT_EQ(keys_of(result["probes"]["bob"]),
            (std::vector<std::string>{"body", "node", "position", "rest", "velocity"}));
  EXPECT_EQ(keys_of(result["bodies"]["pendulum"]),
            (std::vector<std::string>{"center_of_mass", "elements", "inverted", "min_j", "particles"}));
  EXPECT_EQ(result["scene"], "pendulum");
  EXPECT_EQ(result["state"], "finished");
  EXPECT_EQ(result["integrator"], "rk4");
  EXPECT_EQ(result["steps"], 10);
  EXPECT_DOUBLE_EQ(result["time"], 0.01);
  EXPECT_TRUE(result["report"]["min_j"].is_null());
  EXPECT_EQ(result["handles"], Json::object());
  EXPECT_EQ(result["warnings"], Json::array());
  EXPECT_EQ(result["state_hash"].get<std::string>().size(), 16u);
  EXPECT_EQ(result["probes"]["bob"]["node"], 1);
  EXPECT_EQ(result["probes"]["bob"]["rest"], Json({1.0, 0.0, 0.0}));
}

TEST_F(LabRun, ReachesThePublishedPlaceOfTheStiffPendulum) {
  options_.until = 1.0;
  options_.overrides = {"time.step=1e-4"};
  ASSERT_EQ(run(), 0) << log_.str();
  const Json bob = json()["probes"]["bob"];
  EXPECT_NEAR(bob["position"][0], -0.98619230516, 1e-7);
  EXPECT_NEAR(bob["position"][1], -0.16857139114, 1e-7);
  EXPECT_NEAR(bob["velocity"][0], -0.30120846085, 1e-6);
  EXPECT_NEAR(bob["velocity"][1], 1.7928154714, 1e-6);
}

TEST_F(LabRun, RoundsUntilToWholeSteps) {
  options_.overrides = {"time.step=0.003"};
  options_.until = 0.01;
  ASSERT_EQ(run(), 0);
  EXPECT_EQ(json()["steps"], 3);
  options_.until = 0.0105;
  ASSERT_EQ(run(), 0);
  EXPECT_EQ(json()["steps"], 4);
}

TEST_F(LabRun, OfNoStepsIsTheInitialState) {
  options_.steps = 0;
  ASSERT_EQ(run(), 0);
  EXPECT_EQ(json()["time"], 0.0);
  EXPECT_EQ(json()["probes"]["bob"]["position"], Json({1.0, 0.0, 0.0}));
}

TEST_F(LabRun, EndsWithTheDurationOrAfterAThousandSteps) {
  options_.overrides = {"time.duration=0.02"};
  ASSERT_EQ(run(), 0);
  EXPECT_EQ(json()["steps"], 20);

  std::ofstream(folder_ / "endless.toml")
      << "name = \"endless\"\n[[body]]\nname = \"rope\"\nmodel = \"mass_spring\"\nmass = 1\n"
         "mesh = { shape = \"rope\", cells = [1], size = [1.0] }\nsprings = { stiffness = 1.0 }\n";
  options_.scene = folder_ / "endless.toml";
  options_.overrides.clear();
  ASSERT_EQ(run(), 0) << log_.str();
  EXPECT_EQ(json()["steps"], 1000);
}

TEST_F(LabRun, RefusesAnEndThatNeverComes) {
  options_.until = 1e300;
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(log_.str(),
            "flexcast-lab: --until or time.duration: 1e+300 s is too long (allowed: at most 1e15 steps of time.step = "
            "0.001 s)\n");
}

TEST_F(LabRun, WritesARowPerFrameStartingWithTheInitialState) {
  options_.csv = folder_ / "frames.csv";
  options_.steps = 10;
  options_.overrides = {"stream.every=3"};
  ASSERT_EQ(run(), 0) << log_.str();
  const auto lines = lines_of(*options_.csv);
  ASSERT_EQ(lines.size(), 1u + 4u);
  EXPECT_EQ(
      lines[0],
      "step,time,kinetic,elastic,gravity,contact,work,dissipated,numerical,residual,iterations,inverted,min_j,substeps,"
      "error_estimate,momentum.x,"
      "momentum.y,momentum.z,angular_momentum.x,angular_momentum.y,angular_momentum.z,bob.x,bob.y,bob.z,bob.vx,"
      "bob.vy,bob.vz");
  EXPECT_EQ(lines[1], "0,0,0,0,0,0,0,0,0,0,0,0,,0,,0,0,0,0,0,0,1,0,0,0,0,0");
  EXPECT_TRUE(lines[2].starts_with("3,0.003")) << lines[2];
  EXPECT_TRUE(lines[4].starts_with("9,0.0")) << lines[4];
  for (const std::string& line : lines)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(lines[0].begin(), lines[0].end(), ','));
}

TEST_F(LabRun, WritesNumbersThatReadBackAsTheSameDoubles) {
  options_.csv = folder_ / "frames.csv";
  options_.positions = folder_ / "positions.txt";
  options_.steps = 7;
  ASSERT_EQ(run(), 0) << log_.str();
  const Json position = json()["probes"]["bob"]["position"];
  const auto positions = lines_of(*options_.positions);
  ASSERT_EQ(positions.size(), 2u);
  EXPECT_EQ(positions[0], "0 0 0");
  std::istringstream bob(positions[1]);
  for (int axis = 0; axis < 3; ++axis) {
    double value = NAN;
    bob >> value;
    EXPECT_EQ(value, position[axis].get<double>());
  }
  const std::string last = lines_of(*options_.csv).back();
  EXPECT_NE(last.find("," + positions[1].substr(0, positions[1].find(' ')) + ","), std::string::npos) << last;
}

TEST_F(LabRun, SaysWhenAFileCannotBeWritten) {
  options_.steps = 100;
  options_.csv = folder_ / "no" / "such" / "frames.csv";
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(log_.str(), "flexcast-lab: " + options_.csv->string() + ": cannot be written: No such file or directory\n");
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (auto* file : {&options_.csv, &options_.positions}) {
    options_.csv.reset();
    *file = "/dev/full";
    EXPECT_EQ(run(), 1);
    EXPECT_EQ(log_.str(), "flexcast-lab: /dev/full: cannot be written: No space left on device\n");
  }
}

TEST_F(LabRun, OfASceneThatIsNoneExplainsAndReturnsOne) {
  options_.overrides = {"pendulum.mass=-1"};
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(out_.str(), "");
  EXPECT_EQ(log_.str(),
            "flexcast-lab: --set pendulum.mass=-1: [[body]] \"pendulum\": mass = -1 is out of range (allowed: > 0, "
            "kg)\n");
}

TEST_F(LabRun, ThatFailsPrintsTheLastGoodStateAndTheCause) {
  options_.overrides = {"time.integrator=symplectic_euler", "time.step=1.0", "pendulum.stiffness=1e12"};
  options_.steps = 1000;
  EXPECT_EQ(run(), 1);
  const Json result = json();
  EXPECT_EQ(result["state"], "failed");
  EXPECT_LT(result["steps"], 1000);
  EXPECT_EQ(result["failure"]["step"], result["steps"].get<int>() + 1);
  EXPECT_FALSE(result["failure"]["cause"].get<std::string>().empty());
  EXPECT_FALSE(result["failure"]["suggestion"].get<std::string>().empty());
  for (const char* key : {"body", "element", "particle", "position"}) EXPECT_TRUE(result["failure"].contains(key));
  for (double component : result["probes"]["bob"]["position"]) EXPECT_TRUE(std::isfinite(component));
  EXPECT_EQ(result["warnings"].size(), 1u);
  EXPECT_NE(log_.str().find("failed"), std::string::npos);
}

TEST_F(LabRun, StopsWhenAsked) {
  const std::atomic<bool> stop = true;
  options_.stop = &stop;
  options_.steps = 1000;
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(json()["state"], "stopped");
  EXPECT_EQ(json()["steps"], 1);
}

TEST_F(LabRun, GivesTheSameBitsAgain) {
  options_.scene = FLEXCAST_SOURCE_DIR "/server/scenes/jelly.toml";
  options_.steps = 5;
  ASSERT_EQ(run(), 0);
  const Json first = json();
  ASSERT_EQ(run(), 0);
  EXPECT_EQ(json()["state_hash"], first["state_hash"]);
  EXPECT_EQ(json()["report"], first["report"]);
}

TEST_F(LabRun, TellsPeopleWhatRanHowFastAndWhereTheProbesAre) {
  options_.json = false;
  options_.steps = 10;
  ASSERT_EQ(run(), 0);
  const std::string text = out_.str();
  EXPECT_TRUE(text.starts_with("pendulum: finished, 10 steps of 0.001 s with rk4\n")) << text;
  for (const char* words : {"x real time", "2 particles, 1 springs", "kinetic", "bob", "state hash"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
  EXPECT_EQ(log_.str(), "");
}

TEST_F(LabRun, CountsOnTheLogOnlyWhenProgressIsAskedFor) {
  options_.scene = FLEXCAST_SOURCE_DIR "/server/scenes/cloth.toml";
  options_.steps = 1500;  // long enough for a line
  options_.progress = true;
  ASSERT_EQ(run(), 0);
  EXPECT_NE(log_.str().find("of 1500"), std::string::npos);
  EXPECT_TRUE(log_.str().ends_with("\r\x1b[K"));
}

}  // namespace
}  // namespace flexcast::test
