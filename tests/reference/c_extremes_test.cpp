// C01 to C03: inverted, flat and collapsed tetrahedra.
#include <gtest/gtest.h>

#include "tests/reference/golden_tet.h"
#include "tests/reference/tables.h"

namespace flexcast::test {
namespace {

// The free corner tetrahedron with F = diag(1, 1, s), moving as a whole with `drift`.
std::unique_ptr<Simulation> make_squashed(std::string_view law, std::string_view integrator, double step, double s,
                                          double mass_damping, const Vec3& drift = Vec3::Zero()) {
  Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}}, {.law = law});
  model.bodies[0].mass_damping = mass_damping;
  const VecX x = flatten({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, s}});
  return std::make_unique<Simulation>(model, make_settings(std::string(integrator), step),
                                      make_state(x, drift.replicate(4, 1)), std::vector<Probe>{});
}

struct Recovery {
  std::string_view law;
  double min_j;  // at the end
};

std::vector<Recovery> recoveries() {
  std::vector<Recovery> rows;
  for (const ReferenceLaw& law : reference_laws()) {
    if (law.law != "linear") rows.push_back({law.law, law.law == "st_venant_kirchhoff" ? -1.0 : 1.0});
  }
  return rows;
}

TEST(Reference, C01_InvertedTetrahedronRecoversUnderDampedSymplecticEuler) {
  for (const Recovery& row : recoveries()) {
    for (const double s : {-0.5, -0.9, -1.5}) {
      SCOPED_TRACE(concat(row.law, " s=", s));
      const auto simulation = make_squashed(row.law, "symplectic_euler", 1e-3, s, 5.0);
      EXPECT_EQ(simulation->calc_report().inverted, 1);
      EXPECT_NEAR(simulation->calc_report().min_j.value(), s, 1e-14);
      run(*simulation, 4000);
      const StepReport report = simulation->calc_report();
      EXPECT_LT(std::abs(report.min_j.value() - row.min_j), 0.02);
      EXPECT_EQ(report.inverted, row.min_j < 0.0 ? 1 : 0);
      EXPECT_LE(report.momentum.norm(), 1e-10 * 1000.0 / 6.0);
    }
  }
}

TEST(Reference, C01_InvertedTetrahedronRecoversUnderBackwardEuler) {
  const Vec3 drift(0.25, -0.5, 1.0);
  for (const Recovery& row : recoveries()) {
    for (const double s : {-0.5, -0.9, -1.5}) {
      SCOPED_TRACE(concat(row.law, " s=", s));
      const auto simulation = make_squashed(row.law, "backward_euler", 1e-2, s, 0.0, drift);
      const Vec3 before = simulation->calc_report().momentum;
      run(*simulation, 200);
      const StepReport report = simulation->calc_report();
      EXPECT_LT(std::abs(report.min_j.value() - row.min_j), 0.02);
      EXPECT_EQ(report.inverted, row.min_j < 0.0 ? 1 : 0);
      EXPECT_LE((report.momentum - before).norm(), 1e-10 * before.norm());
    }
  }
}

void expect_finite_steps(const Model& model, const VecX& x) {
  for (const ReferenceScheme& scheme : reference_schemes()) {
    SCOPED_TRACE(concat(model.bodies[0].law->name, " ", scheme.integrator));
    Simulation simulation(model, make_settings(std::string(scheme.integrator), 1e-3), make_state(x), {});
    for (int i = 0; i < 100; ++i) {
      ASSERT_TRUE(simulation.step()) << simulation.failure()->text();
      ASSERT_TRUE(simulation.state().positions.allFinite());
      ASSERT_TRUE(simulation.state().velocities.allFinite());
    }
    const StepReport report = simulation.calc_report();
    EXPECT_TRUE(std::isfinite(report.kinetic) && std::isfinite(report.elastic));
    EXPECT_LE(report.momentum.norm(), 1e-10 * 1000.0 / 6.0);
  }
}

TEST(Reference, C02_FlatTetrahedronIsSteppedByEveryScheme) {
  for (const ReferenceLaw& law : reference_laws()) {
    const Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}}, {.law = law.law});
    expect_finite_steps(model, flatten({{0, 0, 0}, {1, 0, 0}, {0, 0.9, 0}, {0, 0, 0}}));
  }
}

TEST(Reference, C02_FlatTetrahedronIsPushedOutOfItsPlaneAsPublished) {
  const Json states = load_reference("materials.json")["homogeneous"];
  for (const ReferenceLaw& law : reference_laws()) {
    const Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}}, {.law = law.law});
    const VecX f = measure_forces(model, flatten({{0, 0, 0}, {1, 0, 0}, {0, 0.9, 0}, {0, 0, 0}}));
    const double P33 = states["flat_diag(1,0.9,0)"][std::string(law.key)]["P"][2][2];
    EXPECT_NEAR(f[11], -P33 / 6.0, 1e-12 * young) << law.law;
  }
}

TEST(Reference, C03_CollapsedTetrahedronIsSteppedByEveryScheme) {
  for (const ReferenceLaw& law : reference_laws()) {
    const Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}}, {.law = law.law});
    for (const double at : {0.0, 0.3}) expect_finite_steps(model, VecX::Constant(12, at));
  }
}

TEST(Reference, C03_StressOfACollapsedTetrahedronIsAsPublished) {
  for (const ReferenceLaw& law : reference_laws()) {
    const Mat3 F = Mat3::Zero();
    Mat3 P;
    find_law(law.law)->calc_stress(calc_lame(young, 0.3), {&F, 1}, {&P, 1});
    SCOPED_TRACE(law.law);
    if (law.law == "linear") {
      EXPECT_LE(calc_max_error(P, -325000.0 * Mat3::Identity()), 1e-12 * 325000.0);
    } else if (law.law == "corotational") {  // any rotation times -325000
      EXPECT_LE(calc_max_error(P * P.transpose(), 325000.0 * 325000.0 * Mat3::Identity()), 1e-12 * 325000.0 * 325000.0);
      EXPECT_LT(P.determinant(), 0.0);
    } else {
      EXPECT_TRUE(P.isZero(0.0));
    }
  }
}

}  // namespace
}  // namespace flexcast::test
