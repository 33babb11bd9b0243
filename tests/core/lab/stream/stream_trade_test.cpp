// flexcast-lab trade --stream: sizes and errors of the formats. How long anything takes is nobody's promise.
#include "core/lab/stream/stream_trade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/lab/options.h"
#include "core/lab/stream/stream_errors.h"
#include "core/sim/frame_size.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

using Json = nlohmann::json;
using enum StreamPrecision;

constexpr const char* beam_scene = R"(
name = "beam"
gravity = [0, 0, -9.81]
[time]
step = 0.002
integrator = "backward_euler"
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [4, 1, 1], size = [1.0, 0.2, 0.2] }
material = { law = "corotational", young = 1e5, poisson = 0.3, density = 1000.0 }
pin = [ { select = { box = [[-1e-9, -1, -1], [1e-9, 1, 1]] } } ]
)";

constexpr const char* rope = R"(
name = "rope"
gravity = [0, 0, -9.81]
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [5], size = [1.0] }
springs = { stiffness = 5.0 }
mass = 0.01
velocity = [ { select = { nodes = [2] }, value = [0.1, 0.0, 0.2] } ]
)";

class LabStreamTrade : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("flexcast_trade_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  int trade(const std::string& scene, const std::vector<std::string>& more) {
    std::ofstream(folder_ / "scene.toml") << scene;
    std::vector<std::string> arguments = {"trade", folder_ / "scene.toml", "--stream"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const LabCommand command = parse_lab_command(arguments);
    if (const auto* end = std::get_if<CommandLineEnd>(&command)) return log_ << end->text, end->exit_code;
    StreamTradeOptions options = std::get<StreamTradeOptions>(command);
    options.stop = &stop_;
    out_.str("");
    return stream_trade_verb(options, out_, log_);
  }
  Json json() const { return Json::parse(out_.str()); }
  Json find(const std::string& precision, std::size_t fields, int every) const {
    const Json all = json()["rows"];
    for (const Json& row : all)
      if (row["precision"] == precision && row["fields"].size() == fields && row["every"] == every) return row;
    ADD_FAILURE() << precision << fields << every;
    return {};
  }
  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder_;
  std::ostringstream out_, log_;
  std::atomic<bool> stop_ = false;
};

TEST_F(LabStreamTrade, HasARowForEveryFormat) {
  ASSERT_EQ(trade(beam_scene, {"--until", "0.1", "--json"}), 0) << log_.str();
  EXPECT_EQ(json()["rows"].size(), 27u);
  EXPECT_EQ(json()["steps"], 50);
  EXPECT_EQ(json()["particles"], 20);
  EXPECT_NEAR(json()["size"], std::sqrt(1.08), 1e-12);
  const Json row = find("quantized16", 4, 10);
  EXPECT_EQ(row["frame_bytes"], calc_wire_bytes(20, {true, true, quantized16, true, true}, 4));
  EXPECT_NEAR(row["bytes_per_second"], row["frame_bytes"].get<double>() / 0.02, 1e-9);
  EXPECT_GT(row["prepare_seconds"], 0.0);
}

TEST_F(LabStreamTrade, DoublesOfEveryStepLoseNothingAndOthersTheirRounding) {
  ASSERT_EQ(trade(beam_scene, {"--until", "0.1", "--json"}), 0) << log_.str();
  EXPECT_EQ(find("float64", 1, 1)["error"], 0.0);
  const double single = find("float32", 1, 1)["error"], quantized = find("quantized16", 1, 1)["error"];
  EXPECT_GT(single, 0.0);
  EXPECT_LT(single, std::sqrt(3.0) * 6e-8);
  EXPECT_GT(quantized, 0.3 / 65535.0);
  EXPECT_LT(quantized, 0.5 * 1.2 / 65535.0);  // half of the diagonal's quantum
  EXPECT_GT(find("float64", 1, 2)["error"], 0.0);
  EXPECT_GT(find("float64", 1, 10)["error"], find("float64", 1, 2)["error"]);
  EXPECT_EQ(find("float32", 4, 10)["error"], find("float32", 1, 10)["error"]);  // of positions, whatever else is sent
}

TEST_F(LabStreamTrade, NamesTheCheapestFormats) {
  ASSERT_EQ(trade(beam_scene, {"--until", "0.1", "--json"}), 0) << log_.str();
  const Json cheapest = json()["cheapest"], rows = json()["rows"];
  ASSERT_EQ(cheapest.size(), 3u);
  EXPECT_EQ(cheapest[0]["relative_error"], 1e-3);
  EXPECT_EQ(cheapest[0]["precision"], "quantized16");
  EXPECT_EQ(cheapest[2]["precision"], "float32");  // 1e-6 is less than half a quantum
  for (const Json& entry : cheapest) {
    double least = INFINITY;
    for (const Json& row : rows)
      if (row["relative_error"] <= entry["relative_error"]) least = std::min<double>(least, row["bytes_per_second"]);
    EXPECT_EQ(entry["bytes_per_second"], least);
  }
}

TEST_F(LabStreamTrade, WritesItsFiles) {
  ASSERT_EQ(trade(beam_scene, {"--until", "0.02", "-o", folder_ / "new" / "formats"}), 0) << log_.str();
  const std::string csv = read("new/formats/stream.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 28);
  EXPECT_NE(csv.find("\nquantized16,positions+velocities+stretch+stress,10,"), std::string::npos) << csv;
  EXPECT_EQ(Json::parse(read("new/formats/stream.json"))["rows"].size(), 27u);
  EXPECT_NE(out_.str().find("cheapest positions within 1e-03 of the size: quantized16"), std::string::npos)
      << out_.str();
}

TEST_F(LabStreamTrade, HasNoStressWhereThereAreNoTetrahedra) {
  ASSERT_EQ(trade(rope, {"--until", "0.01", "--json"}), 0) << log_.str();
  EXPECT_EQ(find("float32", 3, 1)["fields"], (std::vector<std::string>{"positions", "velocities", "stretch"}));
}

TEST_F(LabStreamTrade, EndsWithAnErrorWhenTheRunDoes) {
  EXPECT_EQ(trade(rope, {"--until", "1", "--set", "rope.stiffness=1e12"}), 1);
  EXPECT_EQ(trade(rope, {"--until", "1e300"}), 1);
  EXPECT_NE(log_.str().find("--until"), std::string::npos);
  EXPECT_EQ(trade(rope, {"--until", "0.01", "-o", folder_ / "scene.toml"}), 1);
  stop_ = true;
  EXPECT_EQ(trade(rope, {}), 1);
  EXPECT_NE(log_.str().find("stopped after step 1 of 1000"), std::string::npos) << log_.str();
}

TEST_F(LabStreamTrade, RefusesWrongOptions) {
  EXPECT_EQ(trade(rope, {"--until", "-1"}), 2);
  EXPECT_EQ(trade(rope, {"--set", "x"}), 2);
  EXPECT_TRUE(std::holds_alternative<CommandLineEnd>(parse_lab_command({"trade", "a.toml"})));
}

// x = t^2 by steps of one: a straight line from one n-th step to the next is (n / 2)^2 too high amid them.
TEST(StreamErrors, OfStraightLinesAreThoseOfInterpolation) {
  StreamErrors errors({1, 2, 10});
  for (int step = 0; step <= 25; ++step) errors.add(Vec3(step * step, 0, 1));
  EXPECT_EQ(errors.calc_largest(float64, 1), 0.0);
  EXPECT_NEAR(errors.calc_largest(float64, 2), 1.0, 1e-12);
  EXPECT_NEAR(errors.calc_largest(float64, 10), 25.0, 1e-11);
}

TEST(StreamErrors, OfMotionInAStraightLineAreRoundingAlone) {
  StreamErrors errors({1, 4});
  for (int step = 0; step <= 12; ++step) errors.add(Vec3(0.5 * step, -step, 3));
  EXPECT_NEAR(errors.calc_largest(float64, 4), 0.0, 1e-14);
  EXPECT_NEAR(errors.calc_largest(quantized16, 4), 0.0, 1e-14);  // one particle is its own box
}

}  // namespace
}  // namespace flexcast::test
