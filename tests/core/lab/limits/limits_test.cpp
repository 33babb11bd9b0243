// flexcast-lab limits: measured limits of explicit schemes against those one knows.
#include "core/lab/limits/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/lab/limits/limits_report.h"
#include "core/lab/options.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

using Json = nlohmann::json;

// A mass of 0.2 kg on a spring of 200 N/m along x: omega^2 = 1000 / s^2.
constexpr double omega = 31.622776601683793;

std::string make_oscillator(double damping) {
  return concat(R"(name = "oscillator"
gravity = [0.0, 0.0, -9.81]
[[body]]
name = "pair"
model = "mass_spring"
mesh = { shape = "rope", cells = [1], size = [0.5] }
mass = 0.2
pin = [ { select = { nodes = [0] } }, { select = { all = true }, axes = "yz" } ]
springs = { stiffness = 100.0, damping = )",
                damping, " }\n");
}

Model load_quiet(const std::string& scene) {
  return make_quiet_model(make(scene)->model());
}

double measure(const std::string& scene, std::string_view integrator) {
  const Limit limit = find_limit(load_quiet(scene), *find_integrator(integrator));
  EXPECT_TRUE(limit.resolved);
  return limit.measured.value_or(-1.0);
}

constexpr double tolerance = 0.01;  // of the limit

TEST(Limits, OfAnUndampedOscillatorAreThoseOfTheTextbook) {
  for (const auto& [name, times_omega] :
       {std::pair{"symplectic_euler", 2.0}, {"velocity_verlet", 2.0}, {"rk4", 2.0 * std::sqrt(2.0)}}) {
    EXPECT_NEAR(measure(make_oscillator(0.0), name) * omega, times_omega, tolerance * times_omega) << name;
  }
  EXPECT_EQ(measure(make_oscillator(0.0), "forward_euler"), 0.0);
}

// Whatever is predicted: what the scheme itself does at a step below and above the limit.
TEST(Limits, AreWhereAPerturbationBeginsToGrow) {
  const Model undamped = load_quiet(make_oscillator(0.0)), damped = load_quiet(make_oscillator(2.0));
  const auto grows = [](const Model& model, std::string_view name, double h) {
    const IntegratorRow& scheme = *find_integrator(name);
    return Perturbation(model).grows(scheme, h, choose_watch(scheme));
  };
  for (const auto& [name, limit] : {std::pair{"symplectic_euler", 2.0 / omega},
                                    {"velocity_verlet", 2.0 / omega},
                                    {"rk4", 2.0 * std::sqrt(2.0) / omega}}) {
    EXPECT_FALSE(grows(undamped, name, 0.995 * limit)) << name;
    EXPECT_TRUE(grows(undamped, name, 1.01 * limit)) << name;
  }
  EXPECT_FALSE(grows(damped, "forward_euler", 0.995 * 0.02));
  EXPECT_TRUE(grows(damped, "forward_euler", 1.01 * 0.02));
}

TEST(Limits, OfImplicitSchemesAreNotFound) {
  const Model model = load_quiet(make_oscillator(0.0));
  EXPECT_LE(Perturbation(model).calc_gain(*find_integrator("backward_euler"), {}, 10.0, {20}), 1.0 + 1e-9);
  EXPECT_GT(Perturbation(model).calc_gain(*find_integrator("symplectic_euler"), {}, 10.0, {20}), 1e6);
}

// k_d = 2 N.s: a damper of 4 N.s/m, so c = 20 / s.
TEST(Limits, OfADampedOscillatorFollowTheDamping) {
  const double c = 20.0, omega_squared = 1000.0;
  EXPECT_NEAR(measure(make_oscillator(2.0), "forward_euler"), c / omega_squared, tolerance * c / omega_squared);
  // lambda = -1:  omega^2 h^2 + 2 c h = 4.
  const double symplectic = (-c + std::sqrt(c * c + 4.0 * omega_squared)) / omega_squared;
  EXPECT_NEAR(measure(make_oscillator(2.0), "symplectic_euler"), symplectic, tolerance * symplectic);
}

TEST(Limits, AreNeverBelowWhatTheEngineAdvertises) {
  const Model sheet = load_quiet(R"(
name = "sheet"
[[body]]
name = "sheet"
model = "mass_spring"
mesh = { shape = "grid", cells = [4, 3], size = [1.0, 0.7] }
springs = { stiffness = 40.0, damping = 0.3 }
mass = 0.1
drag = 0.05
pin = [ { select = { nodes = [0, 4] } } ]
)");
  for (const IntegratorRow& row : integrators()) {
    if (row.implicit) continue;
    const Limit limit = find_limit(sheet, row);
    ASSERT_TRUE(limit.measured && limit.predicted) << row.name;
    EXPECT_GE(*limit.measured, *limit.predicted) << row.name;
    EXPECT_GT(*limit.predicted, 0.0) << row.name;
  }
}

// A step above which growth would take longer than one waits is no measured limit.
TEST(Limits, ThatHangOnHowLongOneWaitsAreNotResolved) {
  const Limit limit = find_limit(load_quiet(make_oscillator(1e-4)), *find_integrator("forward_euler"));
  EXPECT_FALSE(limit.resolved);
  EXPECT_FALSE((LimitPoint{1.0, limit}.calc_ratio()));
}

TEST(Limits, OfASceneWithoutStiffnessDoNotExist) {
  Model slack = load_quiet(make_oscillator(0.0));
  slack.bodies[0].stiffness = 0.0;
  const Limit none = find_limit(slack, *find_integrator("rk4"));
  EXPECT_FALSE(none.measured);
  EXPECT_FALSE(none.predicted);
}

TEST(LimitVariations, ChangeWhatTheyAreCalledAfter) {
  const Model model = load_quiet(R"(
name = "beam"
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [2, 1, 1], size = [1.0, 0.5, 0.4] }
material = { law = "corotational", young = 1e4, poisson = 0.3, density = 500.0 }
pin = [ { select = { box = [[0, 0, 0], [0, 1, 1]] } } ]
)");
  const auto change = [&](const char* name, double value) {
    return make_variation(name, model, 5, 100.0).value().change(model, value);
  };
  EXPECT_DOUBLE_EQ(change("stiffness", 10.0).bodies[0].young, 1e5);
  EXPECT_DOUBLE_EQ(change("damping", 0.02).bodies[0].stiffness_damping, 0.02);
  EXPECT_DOUBLE_EQ(change("poisson", 0.49).bodies[0].poisson, 0.49);
  Model heavy = change("mass_ratio", 100.0);
  update_masses(heavy);
  EXPECT_NEAR(heavy.masses.maxCoeff(), 100.0 * model.masses[heavy.bodies[0].mass_overrides[0].particle], 1e-9);
  const Model flat = change("quality", 4.0);
  EXPECT_NEAR(flat.rest_positions.maxCoeff(), 0.5, 1e-12);
  EXPECT_NEAR(flat.rest_positions[3 * 11 + 2] * 4.0, model.rest_positions[3 * 11 + 2], 1e-12);
  EXPECT_DOUBLE_EQ(make_variation("poisson", model, 5, 100.0).value().values.back(), 0.499);
  EXPECT_EQ(make_variation("damping", model, 5, 100.0).value().values.front(), 0.0);
}

TEST(LimitVariations, ThatTheSceneCannotHaveAreNamed) {
  const Model rope = load_quiet(make_oscillator(0.0));
  EXPECT_NE(make_variation("poisson", rope, 5, 1.0).error().message.find("no body of tetrahedra"), std::string::npos);
  EXPECT_NE(make_variation("quality", rope, 5, 1.0).error().message.find("one axis only"), std::string::npos);
}

TEST(LimitVariations, AQuietModelHasNoLoadsAndHoldsItsHandles) {
  Model model = make(make_oscillator(0.0))->model();
  model.handles.push_back({"grip", 0, {1}, {Vec3::Zero()}});
  model.obstacles.push_back({});
  const Model quiet = make_quiet_model(model);
  EXPECT_EQ(quiet.gravity, Vec3::Zero());
  EXPECT_TRUE(quiet.handles.empty());
  EXPECT_TRUE(quiet.obstacles.empty());
  EXPECT_EQ(quiet.fixed[3], 1);
  EXPECT_NEAR(quiet.rest_positions.sum(), 0.0, 1e-15);
}

class LimitsVerb : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("flexcast_limits_") + info->name());
    std::filesystem::create_directories(folder_);
    options_.scene = folder_ / "scene.toml";
    options_.folder = folder_ / "results";
    options_.json = true;
    options_.budget = 1e9;
    std::ofstream(options_.scene) << make_oscillator(0.1);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string read(const char* name) const {
    std::ifstream file(options_.folder / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder_;
  LimitsOptions options_;
  std::ostringstream out_, log_;
};

TEST_F(LimitsVerb, FindsThePowerOfStiffnessAndWritesItsFiles) {
  options_.integrators = {"symplectic_euler", "rk4", "backward_euler"};
  options_.quantities = {"stiffness"};
  options_.points = 3;
  options_.overrides = {"pair.damping=0"};
  ASSERT_EQ(limits_verb(options_, out_, log_), 0) << log_.str();
  const Json found = Json::parse(out_.str());
  ASSERT_EQ(found["quantities"].size(), 1U);
  for (const Json& curve : found["quantities"][0]["curves"]) {
    ASSERT_EQ(curve["points"].size(), 3U);
    for (const Json& power : curve["power"]) EXPECT_NEAR(power.get<double>(), -0.5, 1e-3);
    for (const Json& point : curve["points"]) EXPECT_GE(point["ratio"].get<double>(), 1.0);
  }
  ASSERT_EQ(found["implicit"].size(), 3U);
  for (const Json& run : found["implicit"]) EXPECT_TRUE(run["bounded"].get<bool>());
  EXPECT_EQ(Json::parse(read("limits.json")), found);
  EXPECT_TRUE(read("limits.svg").starts_with("<svg "));
  const std::string csv = read("limits.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_TRUE(csv.starts_with("quantity,value,integrator,measured,predicted,ratio,resolved\n"));
}

TEST_F(LimitsVerb, SaysWhatItLeavesOut) {
  options_.integrators = {"rk4"};
  options_.quantities = {"poisson", "stiffness"};
  options_.budget = -1.0;
  ASSERT_EQ(limits_verb(options_, out_, log_), 0);
  EXPECT_NE(log_.str().find("poisson: the scene has no body of tetrahedra"), std::string::npos) << log_.str();
  EXPECT_NE(log_.str().find("stiffness: 7 of 7 measurements were left out"), std::string::npos) << log_.str();
}

TEST_F(LimitsVerb, EndsWhenItIsStopped) {
  const std::atomic<bool> stop = true;
  options_.stop = &stop;
  EXPECT_EQ(limits_verb(options_, out_, log_), 1);
  EXPECT_NE(log_.str().find("28 of 28 measurements were left out, stopped"), std::string::npos) << log_.str();
  EXPECT_TRUE(Json::parse(out_.str())["implicit"].empty());
}

TEST(Limits, AMeasurementWithoutTimeIsGivenUp) {
  int asked = 0;
  find_limit(load_quiet(make_oscillator(2.0)), *find_integrator("forward_euler"), [&] { return ++asked > 0; });
  EXPECT_GT(asked, 0);
  EXPECT_LT(asked, 20);
}

TEST_F(LimitsVerb, AFolderThatCannotBeMadeIsRefusedBeforeAnythingIsMeasured) {
  options_.folder = options_.scene / "results";
  options_.scene = folder_ / "none.toml";
  EXPECT_EQ(limits_verb(options_, out_, log_), 1);
  EXPECT_NE(log_.str().find("results: cannot be made"), std::string::npos) << log_.str();
}

TEST_F(LimitsVerb, ASceneThatIsHeldEverywhereIsRefused) {
  options_.overrides = {"pair.pin=[{ select = { all = true } }]"};
  EXPECT_EQ(limits_verb(options_, out_, log_), 1);
  EXPECT_NE(log_.str().find("no free particle"), std::string::npos) << log_.str();
}

TEST(LimitsReport, NamesAnAdvertisedLimitAboveTheTrueOne) {
  Limits limits;
  limits.panels.push_back({make_variation("stiffness", load_quiet(make_oscillator(0.0)), 2, 1.0).value(),
                           {{"rk4", {{0.01, {0.9, true, 1.0}}, {1e4, {std::nullopt, true, std::nullopt}}}}}});
  limits.runs = {{"xpbd", 0.1, std::numeric_limits<double>::infinity()}};
  const std::string text = make_limits_text(limits);
  EXPECT_NE(text.find("from 0.9000 (rk4, stiffness 0.01)"), std::string::npos) << text;
  EXPECT_NE(text.find("a bug of the engine"), std::string::npos);
  EXPECT_NE(text.find("no limit"), std::string::npos);
  EXPECT_NE(text.find("BLOWS UP"), std::string::npos);
  limits.panels[0].curves[0].points[0].limit = {1.00001, true, 1.0};
  EXPECT_NE(make_limits_text(limits).find("1.0000 everywhere"), std::string::npos) << make_limits_text(limits);
  const auto json = make_limits_json(limits);
  EXPECT_TRUE(json["implicit"][0]["gain"].is_null());
  EXPECT_EQ(make_limits_plot(limits).panels.back().series.back().notes[0], "xpbd blows up");
}

TEST(LimitsOptions, AreReadAndChecked) {
  const auto command =
      parse_lab_command({"limits", "a.toml", "-o", "out", "--integrators", "rk4,xpbd", "--vary", "damping,quality",
                         "--points", "5", "--budget", "10", "--set", "time.step=1"});
  const auto* options = std::get_if<LimitsOptions>(&command);
  ASSERT_TRUE(options);
  EXPECT_EQ(options->integrators, (std::vector<std::string>{"rk4", "xpbd"}));
  EXPECT_EQ(options->quantities, (std::vector<std::string>{"damping", "quality"}));
  EXPECT_EQ(options->points, 5);
  EXPECT_EQ(options->budget, 10.0);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"limits", "a.toml"},
                                             {"limits", "a.toml", "-o", "out", "--vary", "colour"},
                                             {"limits", "a.toml", "-o", "out", "--integrators", "leapfrog"}}) {
    const auto refused = parse_lab_command(arguments);
    ASSERT_TRUE(std::get_if<CommandLineEnd>(&refused));
    EXPECT_EQ(std::get<CommandLineEnd>(refused).exit_code, 2);
  }
}

}  // namespace
}  // namespace flexcast::test
