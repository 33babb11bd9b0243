// B17: Cook's membrane. R. D. Cook, J. Struct. Div. ASCE 100 (1974) 1851-1863; in three dimensions and in plane strain
// from CalculiX with 20-node bricks.
#include <gtest/gtest.h>

#include "tests/reference/statics.h"

namespace flexcast::test {
namespace {

// (0,0), (48,44), (48,60), (0,44) m, 1 m thick; E = 1 Pa, nu = 1/3; clamped on the left, 1 N upwards over the right.
// `graded`: cells shrink towards all four edges, s -> s^2 (3 - 2 s).
Model make_membrane(std::array<int, 3> cells, bool quadratic, bool plane_strain, bool graded = false) {
  Mesh mesh = make_beam(cells, {1.0, 1.0, 1.0});
  const auto grade = [](double s) { return s * s * (3.0 - 2.0 * s); };
  if (graded) {
    for (Vec3& X : mesh.nodes) X = {grade(X.x()), grade(X.y()), X.z()};
  }
  for (Vec3& X : mesh.nodes) X = {48.0 * X.x(), 44.0 * X.x() + X.y() * (44.0 - 28.0 * X.x()), X.z()};
  Model model =
      make_solid_model(mesh, {.law = "linear", .young = 1.0, .poisson = 1.0 / 3.0, .density = 1.0}, quadratic);
  hold(model, [](const Vec3& X) { return X.x() == 0.0; });
  if (plane_strain)
    hold(
        model, [](const Vec3&) { return true; }, 2);
  load(model, [](const Vec3& X) { return X.x() > 48.0 - 1e-9; }, {0, 1, 0});
  return model;
}

// m, upwards, at the right edge.
double calc_rise(const Simulation& simulation, double y) {
  return displacement(simulation, find_particle(simulation.model(), {48.0, y, 0.0})).y();
}

TEST(Reference, B17_CooksMembraneOfLinearTetrahedraRisesAsItsDigitsSay) {
  for (const auto& [cells, expected] : {std::pair{8, 15.0535347773}, {16, 19.0679083272}, {32, 20.7740384869}}) {
    const auto simulation = solve_equilibrium(make_membrane({cells, cells, 1}, false, true));
    EXPECT_NEAR(calc_rise(*simulation, 52.0), expected, 1e-6 * expected) << cells;
  }
}

TEST(Reference, B17_CooksMembraneOfQuadraticTetrahedraReachesPlaneStrain) {
  const auto simulation = solve_equilibrium(make_membrane({20, 20, 1}, true, true, true));
  EXPECT_NEAR(calc_rise(*simulation, 52.0), 21.52, 0.02);
  EXPECT_NEAR(calc_rise(*simulation, 60.0), 22.60, 0.02);
}

TEST(Reference, B17_CooksMembraneOfQuadraticTetrahedraReachesTheFreePlate) {
  const auto simulation = solve_equilibrium(make_membrane({16, 16, 1}, true, false, true));
  EXPECT_NEAR(calc_rise(*simulation, 52.0), 23.95, 0.02);
}

}  // namespace
}  // namespace flexcast::test
