// flexcast-lab bench: the figures are there, of the right things. How large they are is nobody's promise.
#include "core/lab/bench/bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/lab/bench/bench_kernels.h"
#include "core/lab/bench/bench_state.h"
#include "core/lab/bench/bench_timing.h"
#include "core/lab/options.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

using Json = nlohmann::json;

constexpr const char* beam = R"(
name = "beam"
[time]
step = 0.01
integrator = "backward_euler"
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [4, 2, 1], size = [1.0, 0.25, 0.125] }
material = { law = "neo_hookean", young = 1e5, poisson = 0.3, density = 1000.0 }
pin = [ { select = { nodes = [0, 5, 10] } } ]
)";

constexpr const char* cloth = R"(
name = "cloth"
[[body]]
name = "cloth"
model = "mass_spring"
mesh = { shape = "grid", cells = [3, 3], size = [1.0, 1.0] }
springs = { stiffness = 5.0, damping = 0.01 }
mass = 0.01
)";

class LabBench : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::path(testing::TempDir()) /
            (std::string("flexcast_bench_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml");
  }
  void TearDown() override { std::filesystem::remove(path_); }

  int bench(const std::string& scene, const std::vector<std::string>& more) {
    std::ofstream(path_) << scene;
    std::vector<std::string> arguments = {"bench", path_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const LabCommand command = parse_lab_command(arguments);
    if (const auto* end = std::get_if<CommandLineEnd>(&command)) return log_ << end->text, end->exit_code;
    out_.str("");
    return bench_verb(std::get<BenchOptions>(command), out_, log_);
  }
  Json json() const { return Json::parse(out_.str()); }

  std::filesystem::path path_;
  std::ostringstream out_, log_;
};

void expect_figures(const Json& figures, const std::vector<std::string>& more) {
  std::vector<std::string> keys = {"elements",
                                   "particles",
                                   "threads",
                                   "force_ns_per_element",
                                   "scalar_force_ns_per_element",
                                   "copy_ns_per_element",
                                   "scalar_over_force",
                                   "force_over_copy",
                                   "tangent_ns_per_element",
                                   "cg_iteration_ns_per_element",
                                   "preconditioned_iteration_ns_per_element",
                                   "step_ms",
                                   "steps",
                                   "setup_seconds"};
  keys.insert(keys.end(), more.begin(), more.end());
#ifndef FLEXCAST_SANITIZED  // which has an allocator of its own
  keys.insert(keys.end(), {"bytes_per_element", "bytes_per_particle"});
#endif
  for (const std::string& key : keys) {
    ASSERT_TRUE(figures.contains(key)) << key;
    const double value = figures[key];
    EXPECT_TRUE(std::isfinite(value) && value > 0.0) << key << " = " << value;
  }
}

TEST_F(LabBench, GivesEveryFigureOfTetrahedra) {
  ASSERT_EQ(bench(beam, {"--json", "--set", "solver.linear=pcg", "--set", "gravity=[0, 0, -9.81]"}), 0) << log_.str();
  expect_figures(json(), {"solver_iterations", "kernel_share"});
  EXPECT_EQ(json()["scene"], "beam");
  EXPECT_EQ(json()["integrator"], "backward_euler");
  EXPECT_EQ(json()["elements"], 6 * 4 * 2 * 1);
  EXPECT_EQ(json()["particles"], 5 * 3 * 2);
  EXPECT_EQ(json()["steps"], 30);
}

TEST_F(LabBench, GivesEveryFigureOfSprings) {
  ASSERT_EQ(bench(cloth, {"--json"}), 0) << log_.str();
  expect_figures(json(), {"kernel_share"});
  EXPECT_EQ(json()["elements"], 2 * 12 + 2 * 9 + 2 * 8);
  EXPECT_EQ(json()["particles"], 16);
  EXPECT_EQ(json()["solver_iterations"], 0.0);
}

TEST_F(LabBench, TimesConjugateGradientsWhereTheStepsSolveDirectly) {
  ASSERT_EQ(bench(beam, {"--json"}), 0) << log_.str();
  EXPECT_EQ(json()["solver_iterations"], 0.0);
  EXPECT_GT(json()["cg_iteration_ns_per_element"], 0.0);
}

TEST_F(LabBench, TakesThreadsAndChangedValues) {
  ASSERT_EQ(bench(beam, {"--json", "--threads", "2", "--set", "time.integrator=xpbd", "--set", "beam.element=tet10"}),
            0)
      << log_.str();
  EXPECT_EQ(json()["threads"], 2);
  EXPECT_EQ(json()["integrator"], "xpbd");
  EXPECT_EQ(json()["elements"], 48);
  EXPECT_GT(json()["particles"], 30);
  EXPECT_TRUE(json()["kernel_share"].is_null());
}

TEST_F(LabBench, PrintsATableForPeople) {
  ASSERT_EQ(bench(cloth, {}), 0) << log_.str();
  for (const char* part : {"cloth: 58 elements, 16 particles, symplectic_euler, 1 thread\n", "force", "plain loop",
                           "copy", "tangent", "CG iteration", "step", "memory", "setup"}) {
    EXPECT_NE(out_.str().find(part), std::string::npos) << part << "\n" << out_.str();
  }
}

TEST_F(LabBench, RefusesWhatCannotBeTimed) {
  EXPECT_EQ(bench(cloth, {"--set", "time.step=1e9"}), 1);  // it blows up
  EXPECT_EQ(bench(std::string(cloth) + "pin = [ { select = { all = true } } ]\n", {}), 1);
  EXPECT_NE(log_.str().find("no free particle"), std::string::npos) << log_.str();
  EXPECT_EQ(bench("name = 3\n", {}), 1);
  EXPECT_EQ(out_.str(), "");
}

TEST_F(LabBench, RefusesWrongOptions) {
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"--threads", "0"}, {"--threads", "many"}, {"--steps", "3"}, {"--set", "time.step"}, {"another.toml"}}) {
    EXPECT_EQ(bench(cloth, wrong), 2) << testing::PrintToString(wrong);
  }
  EXPECT_TRUE(std::holds_alternative<CommandLineEnd>(parse_lab_command({"bench"})));
}

// The longest an entry of `a` differs from `b`, over the largest of `b`.
double calc_difference(const VecX& a, const VecX& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

TEST(BenchKernels, ComputeTheSameForcesAsThePlainLoop) {
  for (const std::string& scene :
       {std::string(beam), std::string(beam) + "element = \"tet10\"\n", std::string(cloth)}) {
    const std::unique_ptr<Simulation> simulation = make(scene);
    Kernels kernels(simulation->model());
    kernels.run_force();
    kernels.run_scalar_force();
    EXPECT_GT(kernels.force().norm(), 0.0);
    EXPECT_LT(calc_difference(kernels.force(), kernels.scalar_force()), 1e-12) << scene;
  }
}

TEST(BenchKernels, IterateLongerFromZeroThanFromTheSolution) {
  const std::unique_ptr<Simulation> simulation = make(beam);
  Kernels kernels(simulation->model());
  EXPECT_GE(kernels.run_long_solve(Kernels::Iterations::plain), 20);
  EXPECT_LT(kernels.run_short_solve(Kernels::Iterations::plain), 3);
}

TEST(BenchState, TurnsNoTetrahedronInsideOut) {
  const std::unique_ptr<Simulation> simulation = make(beam);
  const Model& model = simulation->model();
  const VecX x = make_deformed_positions(model);
  EXPECT_EQ(x, make_deformed_positions(model));
  EXPECT_GT((x - model.rest_positions).cwiseAbs().maxCoeff(), 0.1);
  const auto six_volumes = [&](const VecX& at, const Tetrahedron& t) {
    const Vec3 x0 = block3(at, t[0]);
    return (block3(at, t[1]) - x0).dot((block3(at, t[2]) - x0).cross(block3(at, t[3]) - x0));
  };
  for (const Tetrahedron& t : model.tetrahedra) {
    EXPECT_NEAR(six_volumes(x, t) / six_volumes(model.rest_positions, t), 1.0, 0.4);
  }
}

TEST(BenchState, MovesSpringsByTheNoiseAlone) {
  const std::unique_ptr<Simulation> simulation = make(cloth);
  const Model& model = simulation->model();
  const VecX moved = make_deformed_positions(model) - model.rest_positions;
  EXPECT_GT(moved.cwiseAbs().minCoeff(), 0.0);
  EXPECT_LT(moved.cwiseAbs().maxCoeff(), 0.02 * 2.0 / 3.0);  // of the longest spring
}

TEST(BenchTiming, TakesTurns) {
  std::string order;
  Turns turns;
  turns.add([&] { order += 'a'; });
  turns.add([&] { order += 'b'; }, [&] { order += '-'; });
  const std::vector<double> seconds = turns.measure({.sample = 0.0, .turns = 3, .least_turns = 1});
  ASSERT_EQ(seconds.size(), 2u);
  EXPECT_EQ(order, "aa-bba-ba-ba-b");
}

TEST(BenchTiming, MedianIsInTheMiddle) {
  EXPECT_EQ(calc_median({3.0}), 3.0);
  EXPECT_EQ(calc_median({9.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(calc_median({4.0, 1.0, 2.0, 3.0}), 3.0);
}

}  // namespace
}  // namespace flexcast::test
