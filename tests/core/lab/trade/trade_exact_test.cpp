// Exact solutions are what they claim to be, and refuse scenes that do not move so.
#include "core/lab/trade/trade_exact.h"

#include <gtest/gtest.h>

#include "core/forces/system.h"
#include "core/scene/keys.h"
#include "tests/core/lab/trade/trade_case.h"
#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

std::string refusal_of(const std::string& name, const std::string& text,
                       const std::vector<std::string>& overrides = {}) {
  const Scene scene = loaded(text, overrides);
  const auto solution = find_exact(name)->make(*scene.simulation);
  return solution ? "accepted" : solution.error().message;
}

const std::string flying = R"(
name = "flying"
gravity = [0.0, 1.0, -9.81]
[[body]]
name = "block"
model = "fem"
mesh = { shape = "beam", cells = [1, 1, 1], size = [1.0, 0.5, 0.5] }
material = { law = "neo_hookean", young = 1e5, poisson = 0.3, density = 1000.0 }
origin = [0.5, 0.0, 2.0]
velocity = [ { select = { all = true }, value = [0.1, 0.2, 3.0] } ]
)";

TEST(TradeExact, HasARowForEveryNameThatScenesMayUse) {
  for (const std::string_view name : exact_names()) EXPECT_NE(find_exact(name), nullptr) << name;
  EXPECT_EQ(exact_solutions().size(), exact_names().size());
  EXPECT_EQ(find_exact("guess"), nullptr);
}

TEST(TradeExact, FreeFlightIsAParabola) {
  const Scene scene = loaded(flying);
  const auto solution = find_exact("free_flight")->make(*scene.simulation);
  ASSERT_TRUE(solution) << solution.error().message;
  const VecX x = solution.value()->calc_positions(2.0);
  for (std::int64_t i = 0; i < scene.simulation->model().particle_count(); ++i) {
    const Vec3 expected = block3(scene.simulation->state().positions, i) + Vec3(0.2, 0.4, 6.0) + Vec3(0.0, 2.0, -19.62);
    EXPECT_LE((block3(x, i) - expected).norm(), 1e-14);
  }
}

TEST(TradeExact, FreeFlightRefusesWhateverBendsTheParabola) {
  EXPECT_EQ(refusal_of("free_flight", flying), "accepted");
  const std::pair<const char*, const char*> cases[] = {
      {"block.pin=[{ select = { nodes = [0] } }]", "particles are pinned"},
      {"block.damping.mass=0.1", "body \"block\" has damping"},
      {"block.drag=0.1", "body \"block\" has drag"},
      {"block.velocity=[{ select = { nodes = [0] }, value = [1, 0, 0] }]", "the velocities of body \"block\" differ"},
      {"block.displacement=[{ select = { nodes = [0] }, value = [1, 0, 0] }]", "the displacements of body \"block\""},
      {"block.force=[{ select = { nodes = [0] }, value = [1, 0, 0] }]", "dead forces"},
      {"contact=[{ name = \"ground\", shape = \"sphere\", center = [0, 0, 0], radius = 1 }]", "obstacle \"ground\""},
      {"block.handle=[{ name = \"grip\", select = { nodes = [0] } }]", "handle \"grip\""}};
  for (const auto& [change, reason] : cases)
    EXPECT_NE(refusal_of("free_flight", flying, {change}).find(reason), std::string::npos) << change;
}

// M x'' = f(x), x'' by differences of fourth order over five times.
TEST(TradeExact, LinearModesSatisfyTheEquationOfMotion) {
  const Scene scene =
      loaded(linear_scene, {"block.displacement=[{ select = { nodes = [11] }, value = [0, 0.01, 0] }]"});
  const auto solution = find_exact("linear_modes")->make(*scene.simulation);
  ASSERT_TRUE(solution) << solution.error().message;
  const System system(scene.simulation->model());
  const double d = 1e-4;
  for (const double t : {0.0137, 0.31, 2.0}) {
    const auto at = [&](double shift) { return solution.value()->calc_positions(t + shift * d); };
    const VecX acceleration = (-at(-2) + 16.0 * at(-1) - 30.0 * at(0) + 16.0 * at(1) - at(2)) / (12.0 * d * d);
    VecX force(acceleration.size());
    system.calc_conservative(at(0), force);
    const VecX expected = force.cwiseProduct(system.inverse_masses());
    EXPECT_LE((acceleration - expected).norm(), 1e-5 * expected.norm()) << t;
  }
}

TEST(TradeExact, LinearModesStartWhereTheSceneDoes) {
  const Scene scene = loaded(linear_scene);
  const auto solution = find_exact("linear_modes")->make(*scene.simulation);
  ASSERT_TRUE(solution);
  const State& start = scene.simulation->state();
  EXPECT_LE((solution.value()->calc_positions(0.0) - start.positions).norm(), 1e-15);
  const double d = 1e-5;
  const VecX velocities = (solution.value()->calc_positions(d) - solution.value()->calc_positions(-d)) / (2.0 * d);
  EXPECT_LE((velocities - start.velocities).norm(), 1e-6 * start.velocities.norm());
}

// A body that nothing holds has modes without a frequency: they fall.
TEST(TradeExact, LinearModesOfAFreeBodyFall) {
  const Scene scene = loaded(linear_scene, {"block.pin=[]", "block.velocity=[]"});
  const auto solution = find_exact("linear_modes")->make(*scene.simulation);
  ASSERT_TRUE(solution) << solution.error().message;
  const VecX fall = solution.value()->calc_positions(1.0) - scene.simulation->state().positions;
  for (std::int64_t i = 0; i < fall.size() / 3; ++i) EXPECT_LE((block3(fall, i) - Vec3(0, 0, -4.905)).norm(), 1e-7);
}

TEST(TradeExact, LinearModesRefuseWhatIsNotLinearOrTooLarge) {
  const std::pair<const char*, const char*> cases[] = {{"block.law=corotational", "does not have the law linear"},
                                                       {"block.damping.stiffness=0.1", "has damping"},
                                                       {"block.pin=[{ select = { all = true } }]", "nothing is free"},
                                                       {"block.mesh.cells=[8,8,8]", "1944 degrees of freedom"}};
  for (const auto& [change, reason] : cases)
    EXPECT_NE(refusal_of("linear_modes", linear_scene, {change}).find(reason), std::string::npos) << change;
}

}  // namespace
}  // namespace flexcast::test
