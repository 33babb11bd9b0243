// C04, C06, C07: where the energies of the laws stop being convex, in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/reference/golden_tet.h"
#include "tests/reference/tables.h"

namespace flexcast::test {
namespace {

double calc_stress_along(std::string_view law, const Vec3& stretches, int axis, double poisson = 0.3) {
  const Mat3 F = stretches.asDiagonal();
  Mat3 P;
  find_law(law)->calc_stress(calc_lame(young, poisson), {&F, 1}, {&P, 1});
  return P(axis, axis);
}

TEST(Reference, C04_NeoHookeanHasNoSecondRestOnTheWayToThePoint) {
  for (const double poisson : {0.3, 0.45, 0.49}) {
    for (int i = 1; i < 1000; ++i) {
      const double s = 1e-3 * i;
      EXPECT_LT(calc_stress_along("neo_hookean", Vec3::Constant(s), 0, poisson), 0.0) << poisson << " s=" << s;
    }
  }
}

TEST(Reference, C04_NeoHookeanTetrahedronShrunkToAQuarterRecovers) {
  const Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}}, {.law = "neo_hookean"});
  Simulation simulation(model, make_settings("backward_euler", 1e-2), make_state(0.25 * flatten(corner_tet())), {});
  double energy = simulation.calc_report().elastic;
  EXPECT_NEAR(simulation.calc_report().min_j.value(), 1.0 / 64.0, 1e-15);
  for (int i = 0; i < 200; ++i) {
    run(simulation, 1);
    EXPECT_LE(calc_energy(simulation), energy * (1.0 + 1e-12) + 1e-12 * young);
    energy = calc_energy(simulation);
  }
  EXPECT_NEAR(simulation.calc_report().min_j.value(), 1.0, 1e-3);
  EXPECT_EQ(simulation.calc_report().inverted, 0);
}

constexpr double softening = 0.57735026918962576;  // 1/sqrt(3)

TEST(Reference, C06_StVenantKirchhoffIsStrongestAtItsPublishedStretch) {
  const auto calc_uniaxial_stress = [](double s) {
    const double lateral = std::sqrt(1.0 - 0.3 * (s * s - 1.0));
    EXPECT_NEAR(calc_stress_along("st_venant_kirchhoff", {s, lateral, lateral}, 1), 0.0, 1e-11 * young);
    return calc_stress_along("st_venant_kirchhoff", {s, lateral, lateral}, 0);
  };
  const auto calc_uniaxial_strain = [](double s) { return calc_stress_along("st_venant_kirchhoff", {s, 1, 1}, 0); };
  EXPECT_NEAR(calc_uniaxial_stress(softening), -25018.5116648838, 1e-12 * 25018.5);
  EXPECT_NEAR(calc_uniaxial_strain(softening), -33678.7657027282, 1e-12 * 33678.8);
  for (double s = 0.01; s < 1.0; s += 0.01) {
    EXPECT_GT(calc_uniaxial_stress(s), calc_uniaxial_stress(softening)) << s;
    EXPECT_GT(calc_uniaxial_strain(s), calc_uniaxial_strain(softening)) << s;
  }
}

// The corner tetrahedron, free to move along z only, its top pushed down with a pressure (Pa) as large implicit steps
// find the equilibrium: the force on the top is V P33.
StepReport push(double pressure, double* stretch) {
  Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}}, {.law = "st_venant_kirchhoff"});
  model.fixed.assign(12, 1);
  model.fixed[11] = 0;
  model.external_forces = VecX::Zero(12);
  model.external_forces[11] = -pressure / 6.0;
  Simulation simulation(model, make_settings("backward_euler", 1e3), make_state(model.rest_positions), {});
  run(simulation, 20);
  *stretch = simulation.state().positions[11];
  return simulation.calc_report();
}

TEST(Reference, C06_PushHarderThanTheStrongestStressIsReportedAsAnInversion) {
  const double strongest = 33678.7657027282;
  double stretch = 0.0;
  const StepReport borne = push(0.99 * strongest, &stretch);
  EXPECT_EQ(borne.inverted, 0);
  EXPECT_TRUE(borne.statistics.converged);
  EXPECT_GT(stretch, softening);
  EXPECT_NEAR(calc_stress_along("st_venant_kirchhoff", {1, 1, stretch}, 2), -0.99 * strongest, 1e-6 * strongest);

  const StepReport collapsed = push(1.01 * strongest, &stretch);
  EXPECT_EQ(collapsed.inverted, 1);
  EXPECT_LT(stretch, -1.0);
  EXPECT_TRUE(std::isfinite(collapsed.elastic));
}

TEST(Reference, C07_CorotationalStressJumpsAtTheMirrorAndVanishesASecondTimeBehindIt) {
  const auto calc_P33 = [](double s) { return calc_stress_along("corotational", {1, 1, s}, 2); };
  for (const double s : {1.5, 1.0, 0.5, 1e-9, 0.0, -1e-9, -0.5, -0.9, -0.999999}) {
    EXPECT_NEAR(calc_P33(s), 175000.0 * (s - 1.0), 1e-12 * 350000.0) << s;
  }
  for (const double s : {-1.000001, -1.1, -1.5, -13.0 / 7.0, -3.0}) {
    EXPECT_NEAR(calc_P33(s), 175000.0 * s + 325000.0, 1e-12 * 350000.0) << s;
  }
  EXPECT_NEAR(calc_P33(-13.0 / 7.0), 0.0, 1e-12 * 350000.0);
  for (const double s : {-1.0, -5.0, -1e3, -1e6}) EXPECT_TRUE(std::isfinite(calc_P33(s))) << s;
}

TEST(Reference, C07_CorotationalTetrahedronBeyondTheSecondZeroStaysFinite) {
  const Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}}, {.law = "corotational"});
  for (const ReferenceScheme& scheme : reference_schemes()) {
    for (const double s : {-1.0, -13.0 / 7.0, -2.5}) {
      const VecX x = flatten({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, s}});
      Simulation simulation(model, make_settings(std::string(scheme.integrator), 1e-3), make_state(x), {});
      for (int i = 0; i < 200; ++i) {
        ASSERT_TRUE(simulation.step()) << scheme.integrator << " s=" << s;
        ASSERT_TRUE(simulation.state().positions.allFinite());
      }
      EXPECT_LE(simulation.calc_report().momentum.norm(), 1e-10 * 1000.0 / 6.0);
    }
  }
}

}  // namespace
}  // namespace flexcast::test
