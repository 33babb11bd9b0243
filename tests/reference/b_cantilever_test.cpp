// B10, B16, B18: bars whose deflection is known in closed form, from third-party solvers, or to the digit for linear
// tetrahedra.
#include <gtest/gtest.h>

#include "tests/reference/statics.h"

namespace flexcast::test {
namespace {

// 1 x 0.1 x 0.1 m, E = 1e6 Pa, 0.1 N of end shear.
Bar cantilever(std::array<int, 3> cells, double poisson, bool quadratic = false) {
  return {.cells = cells,
          .size = {1.0, 0.1, 0.1},
          .elastic = {.law = "linear", .young = 1e6, .poisson = poisson},
          .quadratic = quadratic,
          .end_force = {0, 0, -0.1}};
}

double calc_deflection(const Bar& bar) {  // mm
  return 1e3 * calc_work_mean(*solve_equilibrium(make_clamped_bar(bar)));
}

struct Deflection {
  std::array<int, 3> cells;
  double poisson;
  double expected;  // mm
};

TEST(Reference, B10_LinearTetrahedraBendAsLittleAsTheirDigitsSay) {
  for (const Deflection& row : {Deflection{{10, 1, 1}, 0.3, 0.8843467742},
                                {{20, 2, 2}, 0.3, 2.030519091},
                                {{40, 4, 4}, 0.3, 3.173096090},
                                {{10, 1, 1}, 0.0, 0.9809406154},
                                {{20, 2, 2}, 0.0, 2.211581518},
                                {{40, 4, 4}, 0.0, 3.316902296}}) {
    const double found = calc_deflection(cantilever(row.cells, row.poisson));
    EXPECT_NEAR(found, row.expected, 1e-7 * row.expected) << row.cells[0] << " cells, nu=" << row.poisson;
  }
}

TEST(Reference, B10_LinearTetrahedraOnTheFinestMeshBendAsTheirDigitsSay) {
  EXPECT_NEAR(calc_deflection(cantilever({60, 6, 6}, 0.3)), 3.575585400, 1e-7 * 3.575585400);
  EXPECT_NEAR(calc_deflection(cantilever({60, 6, 6}, 0.0)), 3.671892783, 1e-7 * 3.671892783);
}

TEST(Reference, B10_QuadraticTetrahedraReachTheConvergedDeflection) {
  for (const Deflection& row : {Deflection{{20, 2, 2}, 0.0, 4.0240}, {{20, 2, 2}, 0.3, 4.002}}) {
    const double found = calc_deflection(cantilever(row.cells, row.poisson, true));
    EXPECT_NEAR(found, row.expected, 0.005 * row.expected) << "nu=" << row.poisson;
  }
}

// The scene file says the same as the model built by hand.
TEST(Reference, B10_SceneFileGivesTheSameDeflection) {
  const std::string scene =
      "name = \"cantilever\"\n[time]\nintegrator = \"quasi_static\"\n[solver]\nlinear = \"ldlt\"\n"
      "newton_tolerance = 1e-10\n[[body]]\nname = \"beam\"\nmodel = \"fem\"\n"
      "mesh = { shape = \"beam\", cells = [10, 1, 1], size = [1, 0.1, 0.1] }\nelement = \"tet4\"\n"
      "material = { law = \"linear\", young = 1e6, poisson = 0.3, density = 1000 }\n"
      "pin = [ { select = { box = [[0, 0, 0], [0, 1, 1]] } } ]\n"
      "surface_force = [ { select = { box = [[0.999, 0, 0], [1.001, 1, 1]] }, value = [0, 0, -0.1] } ]\n";
  for (const bool quadratic : {false, true}) {
    std::string text = scene;
    if (quadratic) text.replace(text.find("tet4"), 4, "tet10");
    const auto simulation = make(text);
    EXPECT_TRUE(solve_static(*simulation));
    const double expected = calc_deflection(cantilever({10, 1, 1}, 0.3, quadratic));
    EXPECT_NEAR(1e3 * calc_work_mean(*simulation), expected, 1e-9 * expected);
    if (!quadratic) {
      EXPECT_NEAR(expected, 0.8843467742, 1e-7 * 0.8843467742);
    }
  }
}

struct HangingBar {
  std::array<int, 3> cells;
  double poisson;
  double shortest, longest;  // m, of the displacements of the lower face along the bar
};

// Hangs along x: 1 x 0.1 x 0.1 m, E = 1e5 Pa, 1000 kg/m^3.
std::unique_ptr<Simulation> hang(std::array<int, 3> cells, double poisson) {
  Model model = make_clamped_bar(
      {.cells = cells, .size = {1.0, 0.1, 0.1}, .elastic = {.law = "linear", .young = 1e5, .poisson = poisson}});
  model.gravity = {9.81, 0, 0};
  return solve_equilibrium(model);
}

std::pair<double, double> calc_end_range(const Simulation& simulation) {
  double least = 1.0, most = 0.0;
  for (const std::int64_t i : find_particles(simulation.model(), [](const Vec3& X) { return X.x() > 1.0 - 1e-9; })) {
    least = std::min(least, displacement(simulation, i).x());
    most = std::max(most, displacement(simulation, i).x());
  }
  return {least, most};
}

TEST(Reference, B16_BarUnderItsOwnWeightStretchesAsItsDigitsSay) {
  for (const HangingBar& row : {HangingBar{{10, 2, 2}, 0.0, 0.0474854375826, 0.0505850185080},
                                {{20, 4, 4}, 0.0, 0.0482532534006, 0.0498367380775},
                                {{20, 4, 4}, 0.3, 0.0474591599566, 0.0491761927641}}) {
    SCOPED_TRACE(concat(row.cells[0], " cells, nu=", row.poisson));
    const auto [least, most] = calc_end_range(*hang(row.cells, row.poisson));
    EXPECT_NEAR(least, row.shortest, 1e-9 * row.shortest);
    EXPECT_NEAR(most, row.longest, 1e-9 * row.longest);
  }
}

TEST(Reference, B18_LinearTetrahedraLockAsTheirDigitsSayAndWarn) {
  for (const auto& [poisson, expected] :
       {std::pair{0.45, 1.205612548}, {0.49, 0.420630377}, {0.499, 0.08477473211}, {0.4999, 0.04406590625}}) {
    const auto simulation = solve_equilibrium(make_clamped_bar(cantilever({20, 2, 2}, poisson)), 1e-11);
    EXPECT_NEAR(1e3 * calc_work_mean(*simulation), expected, 1e-5 * expected) << poisson;
    ASSERT_EQ(simulation->calc_warnings().size(), 1u) << poisson;
    EXPECT_NE(simulation->calc_warnings()[0].find("tet10"), std::string::npos) << simulation->calc_warnings()[0];
  }
  EXPECT_TRUE(solve_equilibrium(make_clamped_bar(cantilever({10, 1, 1}, 0.44)))->calc_warnings().empty());
}

TEST(Reference, B18_QuadraticTetrahedraDoNotLock) {
  for (const auto& [poisson, truth] : {std::pair{0.49, 3.955}, {0.4999, 3.94}}) {
    const auto simulation = solve_equilibrium(make_clamped_bar(cantilever({20, 2, 2}, poisson, true)));
    EXPECT_NEAR(1e3 * calc_work_mean(*simulation), truth, 0.05 * truth) << poisson;
    EXPECT_TRUE(simulation->calc_warnings().empty());
  }
}

}  // namespace
}  // namespace flexcast::test
