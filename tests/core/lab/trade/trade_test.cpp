// A whole study: what is measured, what it may cost, what it writes.
#include "core/lab/trade/trade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/lab/options.h"
#include "core/lab/trade/trade_files.h"
#include "core/lab/trade/trade_report.h"
#include "tests/core/lab/trade/trade_case.h"

namespace flexcast::test {
namespace {

using Json = nlohmann::json;
using Status = TradeResult::Status;

class TradeStudy : public TradeCase {
 protected:
  std::string text_of(const std::filesystem::path& path) const {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
};

TEST_F(TradeStudy, ASettingThatBlowsUpIsAResult) {
  write(oscillator_scene);
  options_.integrators = {"velocity_verlet"};
  options_.overrides = {"time.step=0.5", "pair.stiffness=1e4"};
  options_.steps = {0.25, 0.005};
  options_.until = 10.0;
  options_.repeats = 1;
  options_.budget = 20.0;
  const Trade trade = measure();
  ASSERT_EQ(trade.results.size(), 2u);
  EXPECT_EQ(trade.results[0].status, Status::failed);
  EXPECT_TRUE(trade.results[0].cause.starts_with("failed at t = ")) << trade.results[0].cause;
  EXPECT_LT(trade.results[0].time, 10.0);
  EXPECT_EQ(trade.results[1].status, Status::done);
  EXPECT_NE(make_trade_text(trade).find(trade.results[0].cause), std::string::npos);
}

TEST_F(TradeStudy, ARunThatIsTheReferenceHasNoErrorAndIsAtItsLimit) {
  write(oscillator_scene);
  options_.integrators = {"rk4"};
  options_.until = 0.5;
  options_.budget = 20.0;
  const Trade first = measure();
  options_.steps = {first.reference.levels.back().h};
  const Trade trade = measure();
  ASSERT_EQ(trade.results.size(), 1u);
  EXPECT_LE(trade.results[0].errors.rms, 3.0 * trade.reference.error);
  EXPECT_TRUE(trade.results[0].at_limit);
  EXPECT_FALSE(trade.orders[0]);
}

// Implicit midpoint loses no energy on a spring that stays linear, backward Euler does.
TEST_F(TradeStudy, EnergyErrorsAreThoseOfTheScheme) {
  write(linear_scene);
  options_.integrators = {"implicit_midpoint", "backward_euler"};
  options_.steps = {0.002};
  options_.until = 0.1;
  const Trade trade = measure();
  ASSERT_EQ(trade.results.size(), 2u);
  EXPECT_LE(trade.results[0].errors.energy, 1e-9);
  EXPECT_GE(trade.results[1].errors.energy, 1e-2);
}

TEST_F(TradeStudy, KeepsItsBudgetAndSaysWhatWasSkipped) {
  write(linear_scene);
  options_.until = 0.2;
  for (const double budget : {3.0, 20.0}) {
    options_.budget = budget;
    const std::int64_t before = clock_.steps();
    const Trade trade = measure();
    EXPECT_LE(static_cast<double>(clock_.steps() - before), 1e3 * budget);
    EXPECT_GE(std::ranges::count(trade.results, Status::done, &TradeResult::status), 8);
    EXPECT_GE(std::ranges::count(trade.results, Status::skipped, &TradeResult::status), 1);
    for (const TradeResult& result : trade.results) {
      if (result.status == Status::skipped) {
        EXPECT_TRUE(result.cause.starts_with("skipped: ")) << result.cause;
      }
    }
  }
}

TEST_F(TradeStudy, PredictsACostThatItKeepsTo) {
  write(linear_scene);
  options_.integrators = {"symplectic_euler"};
  options_.until = 0.2;
  options_.budget = 50.0;
  const Trade trade = measure();
  for (const TradeResult& result : trade.results) {
    if (result.status == Status::done) {
      EXPECT_NEAR(result.samples.front(), result.predicted, 1e-9);
    }
  }
}

TEST_F(TradeStudy, RepeatsShortRunsAndAsOftenAsTold) {
  write(linear_scene);
  options_.integrators = {"rk4"};
  options_.steps = {0.002, 0.001};
  options_.until = 0.1;
  for (const TradeResult& result : measure().results) EXPECT_GE(result.samples.size(), 3u);
  options_.repeats = 2;
  for (const TradeResult& result : measure().results) EXPECT_EQ(result.samples.size(), 2u);
}

TEST_F(TradeStudy, FitsNothingIntoAMoment) {
  write(oscillator_scene);
  options_.budget = 0.001;
  EXPECT_TRUE(refusal().starts_with("nothing fits into the budget of 0.001 s"));
  EXPECT_LE(clock_.steps(), 30);
}

TEST_F(TradeStudy, ComparesLongStepsAtTheTimesTheyHaveInCommon) {
  write(linear_scene);
  options_.integrators = {"backward_euler"};
  options_.steps = {0.004, 0.006, 0.002};
  options_.until = 0.12;
  const Trade trade = measure();
  EXPECT_EQ(trade.times.compared.size(), 10u);
  ASSERT_EQ(trade.results.size(), 3u);
  EXPECT_GT(trade.results[0].error, trade.results[1].error);
  EXPECT_GT(trade.results[1].error, trade.results[2].error);
}

// A coarse beam is too stiff; a finer one and one of tet10 are nearer to the finest.
TEST_F(TradeStudy, RefinementAndElementsAreComparedOnTheParticlesTheyShare) {
  write(linear_scene);
  options_.overrides = {"block.velocity=[]"};
  options_.integrators = {"rk4"};
  options_.elements = {"tet4", "tet10"};
  options_.refinements = {0, 1};
  options_.steps = {0.0005};
  options_.until = 0.1;
  options_.repeats = 1;
  const Trade trade = measure();
  ASSERT_EQ(trade.results.size(), 4u);
  EXPECT_GT(trade.results[0].error, trade.results[1].error);
  EXPECT_GT(trade.results[1].error, trade.results[2].error);
  EXPECT_LT(trade.results[3].error, 1e-4);
}

TEST_F(TradeStudy, WritesItsFilesAndTheyParse) {
  write(linear_scene);
  options_.integrators = {"rk4", "backward_euler"};
  options_.steps = {0.002, 0.001};
  options_.until = 0.02;
  options_.repeats = 1;
  options_.json = true;
  options_.folder = folder_ / "not" / "yet";
  ASSERT_EQ(trade_verb(options_, out_, log_), 0) << log_.str();
  const Json json = Json::parse(text_of(options_.folder / "trade.json"));
  EXPECT_EQ(json, Json::parse(out_.str()));
  EXPECT_EQ(json["settings"].size(), 4u);
  EXPECT_EQ(json["levels"].size(), 3u);
  EXPECT_EQ(json["reference"]["exact"], "linear_modes");
  EXPECT_TRUE(json["settings"][0]["errors"]["probes"].contains("tip"));
  std::istringstream csv(text_of(options_.folder / "trade.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_NE(lines[0].find(",tip.end,tip.largest"), std::string::npos);
  for (const char* name : {"trade.svg", "order.svg"})
    EXPECT_NE(text_of(options_.folder / name).find("<svg"), std::string::npos) << name;
}

TEST_F(TradeStudy, WithNothingThatEndsStillWritesNumbersOrNull) {
  write(oscillator_scene);
  options_.integrators = {"forward_euler"};
  options_.overrides = {"time.step=0.5", "pair.stiffness=1e6", "pair.displacement=[]"};
  options_.steps = {0.25};
  options_.until = 1.0;
  const Trade trade = measure();
  EXPECT_EQ(trade.motion, 0.0);
  EXPECT_NE(make_trade_text(trade).find("10 %"), std::string::npos);
  EXPECT_EQ(make_trade_text(trade).find("nan"), std::string::npos);
  EXPECT_EQ(make_trade_csv(trade).find("inf"), std::string::npos);
  EXPECT_FALSE(make_trade_json(trade).dump().empty());
}

TEST_F(TradeStudy, InAPlaceThatIsNoFolderIsRefused) {
  write(linear_scene);
  options_.folder = folder_ / "scene.toml";
  EXPECT_EQ(trade_verb(options_, out_, log_), 1);
  EXPECT_NE(log_.str().find("the folder cannot be made"), std::string::npos) << log_.str();
  EXPECT_EQ(out_.str(), "");
}

TEST_F(TradeStudy, OfASceneThatIsNotAsExactAsItSaysIsRefused) {
  write(linear_scene);
  options_.overrides = {"exact=free_flight"};
  EXPECT_TRUE(refusal().starts_with("exact = \"free_flight\" does not hold: particles are pinned"));
}

// Whatever the loader says of the contract, it says it before anything is run.
TEST_F(TradeStudy, OfAContractThatTheLoaderRefusesRunsNothing) {
  write(oscillator_scene);
  options_.tolerances = {-1.0};
  EXPECT_NE(refusal().find("--set time.tolerance=-1"), std::string::npos) << refusal();
  EXPECT_EQ(clock_.steps(), 0);
}

TEST_F(TradeStudy, EndsWhenAskedTo) {
  write(oscillator_scene);
  const std::atomic<bool> stop = true;
  options_.stop = &stop;
  EXPECT_EQ(refusal(), "stopped before there was a reference");
}

TEST(TradeOptionsLine, IsUnderstood) {
  const LabCommand command = parse_lab_command({"trade",
                                                "a.toml",
                                                "-o",
                                                "out",
                                                "--until",
                                                "2.5",
                                                "--integrators",
                                                "rk4,vbd",
                                                "--dt",
                                                "1e-3,5e-4",
                                                "--iterations",
                                                "1,5",
                                                "--tolerances",
                                                "0.01",
                                                "--elements",
                                                "tet4,tet10",
                                                "--refine",
                                                "0,1,2",
                                                "--budget",
                                                "5",
                                                "--set",
                                                "gravity=[0, 0, -3]",
                                                "--repeats",
                                                "4",
                                                "--json",
                                                "--threads",
                                                "2"});
  ASSERT_TRUE(std::holds_alternative<TradeOptions>(command)) << std::get<CommandLineEnd>(command).text;
  const auto& options = std::get<TradeOptions>(command);
  EXPECT_EQ(options.scene, "a.toml");
  EXPECT_EQ(options.folder, "out");
  EXPECT_EQ(options.until, 2.5);
  EXPECT_EQ(options.integrators, (std::vector<std::string>{"rk4", "vbd"}));
  EXPECT_EQ(options.steps, (std::vector<double>{1e-3, 5e-4}));
  EXPECT_EQ(options.iterations, (std::vector<int>{1, 5}));
  EXPECT_EQ(options.tolerances, std::vector<double>{0.01});
  EXPECT_EQ(options.elements, (std::vector<std::string>{"tet4", "tet10"}));
  EXPECT_EQ(options.refinements, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(options.budget, 5.0);
  EXPECT_EQ(options.overrides, std::vector<std::string>{"gravity=[0, 0, -3]"});
  EXPECT_EQ(options.repeats, 4);
  EXPECT_TRUE(options.json);
  EXPECT_EQ(options.threads, 2);
}

TEST(TradeOptionsLine, ThatIsMalformedIsBadUsage) {
  const std::vector<std::vector<std::string>> cases = {{},
                                                       {"-o"},
                                                       {"-o", "out", "--integrators", "rk5"},
                                                       {"-o", "out", "--dt", "0"},
                                                       {"-o", "out", "--dt", "1e-3,x"},
                                                       {"-o", "out", "--dt", "nan"},
                                                       {"-o", "out", "--iterations", "1.5"},
                                                       {"-o", "out", "--iterations", "0"},
                                                       {"-o", "out", "--elements", "hex8"},
                                                       {"-o", "out", "--refine", "-1"},
                                                       {"-o", "out", "--refine", "7"},
                                                       {"-o", "out", "--budget", "0"},
                                                       {"-o", "out", "--until", "inf"},
                                                       {"-o", "out", "--repeats", "0"},
                                                       {"-o", "out", "--set", "no"}};
  for (const auto& extra : cases) {
    std::vector<std::string> arguments = {"trade", "a.toml"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const LabCommand command = parse_lab_command(arguments);
    const auto* end = std::get_if<CommandLineEnd>(&command);
    ASSERT_NE(end, nullptr) << (extra.empty() ? "" : extra.back());
    EXPECT_EQ(end->exit_code, 2);
    EXPECT_FALSE(end->text.empty());
  }
}

}  // namespace
}  // namespace flexcast::test
