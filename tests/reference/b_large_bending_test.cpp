// B13, B14: beams bent far by a dead load.
#include <gtest/gtest.h>

#include "tests/reference/statics.h"

namespace flexcast::test {
namespace {

struct Elastica {
  double alpha;                   // P L^2 / (E I)
  double deflection, shortening;  // of the tip, over L
  double angle;                   // of the tip, rad
};

// K. E. Bisshopp, D. C. Drucker, Q. Appl. Math. 3 (1945) 272; K. Mattiasson, Int. J. Numer. Methods Eng. 17 (1981) 145.
constexpr std::array<Elastica, 5> elasticas = {{{0.25, 0.0827459154, 0.0041178184, 0.1242924421},
                                                {0.5, 0.1621435757, 0.0159189625, 0.2445336471},
                                                {1.0, 0.3017207738, 0.0564332363, 0.4613519497},
                                                {2.0, 0.4934574804, 0.1606417208, 0.7817498316},
                                                {5.0, 0.7137915236, 0.3876283607, 1.2153681176}}};

// h / L = 1/20, nu = 0.
Elastica measure_elastica(std::string_view law, double alpha) {
  const double h = 0.05, E = 1e6;
  const double force = alpha * E * h * h * h * h / 12.0;
  const auto simulation = solve_equilibrium(make_clamped_bar({.cells = {20, 2, 2},
                                                              .size = {1.0, h, h},
                                                              .elastic = {.law = law, .young = E, .poisson = 0.0},
                                                              .quadratic = true,
                                                              .end_force = {0, 0, -force}}));
  const auto at = [&](double z) { return find_particle(simulation->model(), {1.0, 0.5 * h, z}); };
  const Vec3 u = displacement(*simulation, at(0.5 * h));
  const Vec3 across = position(*simulation, at(h)) - position(*simulation, at(0.0));
  return {alpha, -u.z(), -u.x(), std::atan2(across.x(), across.z())};
}

TEST(Reference, B13_DeadLoadBendsABeamIntoTheElastica) {
  for (const char* law : {"corotational", "st_venant_kirchhoff"}) {
    for (const Elastica& exact : elasticas) {
      SCOPED_TRACE(concat(law, " alpha=", exact.alpha));
      const Elastica found = measure_elastica(law, exact.alpha);
      EXPECT_NEAR(found.deflection, exact.deflection, 0.01 * exact.deflection);
      EXPECT_NEAR(found.shortening, exact.shortening, 0.01 * exact.shortening);
      EXPECT_NEAR(found.angle, exact.angle, 0.01 * exact.angle);
    }
  }
}

struct Bent {
  std::string_view law;
  Vec3 displacement;  // m, of the middle of the end face
  double energy;      // J, 0: none published
};

const std::vector<Bent>& bent_beams() {
  static const std::vector<Bent> rows = {
      {"linear", {-0.001521658805, 0.1285518939, -0.7837444499}, 0.0},
      {"corotational", {-0.1989705734, 0.07281494411, -0.5572459093}, 14.02071947},
      {"st_venant_kirchhoff", {-0.2050408726, 0.07307286934, -0.5504799953}, 13.81969765},
      {"neo_hookean", {-0.2024772175, 0.07232866877, -0.5667592501}, 0.0}};
  return rows;
}

Model make_bent_beam(std::string_view law) {
  return make_clamped_bar({.elastic = {.law = law, .young = 1e5, .poisson = 0.3}, .end_force = {0, 0, -60}});
}

void expect_bent(const Simulation& simulation, const Bent& expected, double tolerance) {
  const Vec3 u = displacement(simulation, find_particle(simulation.model(), {1.0, 0.1, 0.1}));
  EXPECT_LE((u - expected.displacement).cwiseAbs().maxCoeff(), tolerance * expected.displacement.norm())
      << u.transpose();
  if (expected.energy > 0.0) {
    EXPECT_NEAR(simulation.calc_report().elastic, expected.energy, tolerance * expected.energy);
  }
}

TEST(Reference, B14_BeamBentFarComesToRestWhereItsDigitsSay) {
  for (const Bent& row : bent_beams()) {
    SCOPED_TRACE(row.law);
    expect_bent(*solve_equilibrium(make_bent_beam(row.law)), row, 1e-6);
  }
}

TEST(Reference, B14_DampedMotionEndsInTheSameEquilibrium) {
  for (const Bent& row : bent_beams()) {
    for (const char* integrator : {"backward_euler", "bdf2"}) {
      SCOPED_TRACE(concat(row.law, " ", integrator));
      Model model = make_bent_beam(row.law);
      model.bodies[0].mass_damping = 4.0;
      Settings settings = make_settings(integrator, 0.05);
      settings.solver.newton_tolerance = 1e-11;
      const auto simulation = make_simulation(model, settings, make_state(model.rest_positions));
      run(*simulation, 500);
      expect_bent(*simulation, row, 1e-4);
      EXPECT_LT(simulation->calc_report().kinetic, 1e-8);
    }
  }
}

}  // namespace
}  // namespace flexcast::test
