// Studies of trades for tests: a scene in a file, and a clock that counts steps instead of seconds.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/lab/trade/trade.h"

namespace flexcast::test {

// A step takes a millisecond; nothing else takes time.
class StepClock : public TradeClock {
 public:
  double now() const override { return 1e-3 * static_cast<double>(steps_); }
  void stepped(std::int64_t count) override { steps_ += count; }
  std::int64_t steps() const { return steps_; }

 private:
  std::int64_t steps_ = 0;
};

class TradeCase : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("flexcast_trade_") + info->name());
    std::filesystem::create_directories(folder_);
    options_.scene = folder_ / "scene.toml";
    options_.folder = folder_ / "out";
    options_.budget = 1e9;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(options_.scene) << text; }

  Trade measure() {
    auto trade = trade_scene(options_, clock_, log_);
    if (!trade) ADD_FAILURE() << trade.error().message;
    return trade ? std::move(trade).value() : Trade{};
  }
  std::string refusal() {
    const auto trade = trade_scene(options_, clock_, log_);
    return trade ? "accepted" : trade.error().message;
  }

  // What a study needs for one run of one mesh.
  struct Runner {
    TradeMeshes meshes;
    TradeTimes times;
    TradeBudget budget;
    TradeRunner runner;
    Runner(const TradeOptions& options, TradeMeshes of, TradeTimes at, TradeClock& clock)
        : meshes(std::move(of)),
          times(std::move(at)),
          budget(clock, options.budget),
          runner(options, meshes, times, budget) {}
  };
  std::unique_ptr<Runner> make_runner(double until) {
    const auto base = load_scene(options_.scene, options_.overrides);
    EXPECT_TRUE(base) << base.error().message;
    auto meshes = make_trade_meshes(options_, base.value());
    auto times = make_trade_times(base.value().simulation->settings().time.step, until, 1);
    EXPECT_TRUE(meshes.ok() && times.ok());
    return std::make_unique<Runner>(options_, std::move(meshes).value(), std::move(times).value(), clock_);
  }

  std::filesystem::path folder_;
  TradeOptions options_;
  StepClock clock_;
  std::ostringstream out_, log_;
};

// A clamped block of the linear law, pushed: smooth and known.
inline const std::string linear_scene = R"(
name = "linear"
exact = "linear_modes"
gravity = [0.0, 0.0, -9.81]
[time]
step = 0.002
[solver]
linear = "ldlt"
linear_tolerance = 1e-14
newton_tolerance = 1e-14
newton_iterations = 50
[[body]]
name = "block"
model = "fem"
mesh = { shape = "beam", cells = [2, 1, 1], size = [1.0, 0.5, 0.5] }
material = { law = "linear", young = 1e5, poisson = 0.3, density = 1000.0 }
pin = [ { select = { box = [[0, 0, 0], [0, 1, 1]] } } ]
velocity = [ { select = { all = true }, value = [0.1, 0.2, 0.0] } ]
[[probe]]
name = "tip"
body = "block"
at = [1.0, 0.5, 0.5]
)";

// A mass on a spring along x, 10 rad/s, without an exact solution in the scene.
inline const std::string oscillator_scene = R"(
name = "oscillator"
[time]
step = 0.01
[[body]]
name = "pair"
model = "mass_spring"
mesh = { shape = "rope", cells = [1], size = [1.0] }
springs = { stiffness = 100.0 }
mass = 1.0
pin = [ { select = { nodes = [0] } }, { select = { all = true }, axes = "yz" } ]
displacement = [ { select = { nodes = [1] }, value = [0.1, 0, 0] } ]
[[probe]]
name = "bob"
body = "pair"
node = 1
)";

}  // namespace flexcast::test
