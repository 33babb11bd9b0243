// C05: a cube scrambled, flattened or shrunk finds back to its shape. The scrambled states are uniform random numbers
// of SplitMix64 with seeds from 1, node after node.
#include <gtest/gtest.h>

#include "core/mesh/topology.h"
#include "tests/reference/statics.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

// 1 m, E = 1e5 Pa, free.
Model make_cube(std::string_view law, double poisson) {
  return make_beam_model(make_beam({3, 3, 3}, {1, 1, 1}), {.law = law, .young = 1e5, .poisson = poisson});
}

VecX make_scrambled(const Model& model, std::uint64_t seed) {
  SplitMix64 random(seed);
  VecX x(model.rest_positions.size());
  for (double& coordinate : x) coordinate = random.uniform();
  return x;
}

struct Rest {
  double min_j = 0.0;
  double edge_error = 0.0;  // m, the largest
  bool converged = false;
};

// Quasi-static steps until one converges, at most so many; the elastic energy may only fall.
Rest relax(const Model& model, const VecX& start, int steps = 20) {
  Settings settings = make_settings("quasi_static", 1.0);
  settings.solver.newton_tolerance = 1e-11;
  settings.solver.newton_iterations = 50;
  const auto simulation = make_simulation(model, settings, make_state(start));
  double energy = simulation->calc_report().elastic;
  for (int i = 0; i < steps; ++i) {
    EXPECT_TRUE(simulation->step());
    EXPECT_TRUE(simulation->state().positions.allFinite());
    const double after = simulation->calc_report().elastic;
    EXPECT_LE(after, energy * (1.0 + 1e-12) + 1e-12 * 1e5);
    energy = after;
    if (simulation->statistics().converged) break;
  }
  Rest rest{simulation->calc_report().min_j.value(), 0.0, simulation->statistics().converged};
  for (const Spring& edge : make_edges(model.tetrahedra)) {
    const auto length = [&](const VecX& x) { return (block3(x, edge[1]) - block3(x, edge[0])).norm(); };
    rest.edge_error =
        std::max(rest.edge_error, std::abs(length(simulation->state().positions) - length(model.rest_positions)));
  }
  return rest;
}

void expect_recovered(const Rest& rest) {
  EXPECT_GT(rest.min_j, 0.999);
  EXPECT_LT(rest.edge_error, 1e-6);
}

TEST(Reference, C05_TheScrambledCoordinatesAreThePublishedOnes) {
  EXPECT_DOUBLE_EQ(SplitMix64(1).uniform(), 0.5665615751722809);
}

TEST(Reference, C05_ScrambledNeoHookeanCubesRecover) {
  for (const double poisson : {0.3, 0.4}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE(concat("nu=", poisson, " seed ", seed));
      const Model model = make_cube("neo_hookean", poisson);
      expect_recovered(relax(model, make_scrambled(model, seed)));
    }
  }
}

TEST(Reference, C05_ScrambledCorotationalCubesRecover) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(concat("seed ", seed));
    const Model model = make_cube("corotational", 0.3);
    expect_recovered(relax(model, make_scrambled(model, seed)));
  }
}

// Nearly incompressible, scrambled cubes have tangled equilibria: those are ends like any other.
TEST(Reference, C05_NearlyIncompressibleScrambledCubesEndAtRestOrSayThatTheyDidNot) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(concat("seed ", seed));
    const Model model = make_cube("neo_hookean", 0.45);
    const VecX start = make_scrambled(model, seed);
    const Rest rest = relax(model, start, 4);
    if (rest.converged) continue;
    EXPECT_TRUE(std::isfinite(rest.min_j));
  }
}

TEST(Reference, C05_FlattenedCubesRecoverUnlessStVenantKirchhoff) {
  for (const char* law : {"corotational", "neo_hookean", "st_venant_kirchhoff"}) {
    SCOPED_TRACE(law);
    const Model model = make_cube(law, 0.3);
    VecX flat = model.rest_positions;
    for (std::int64_t i = 0; i < model.particle_count(); ++i) flat[3 * i + 2] = 0.0;
    const Rest rest = relax(model, flat);
    if (model.bodies[0].law->name != "st_venant_kirchhoff") expect_recovered(rest);
  }
}

TEST(Reference, C05_CubesShrunkAThousandfoldRecover) {
  for (const char* law : {"corotational", "neo_hookean"}) {
    SCOPED_TRACE(law);
    const Model model = make_cube(law, 0.3);
    expect_recovered(relax(model, 1e-3 * model.rest_positions));
  }
}

// The same with inertia, in large implicit steps.
TEST(Reference, C05_ScrambledCubesRecoverUnderBackwardEuler) {
  for (const char* law : {"corotational", "neo_hookean"}) {
    SCOPED_TRACE(law);
    const Model model = make_cube(law, 0.3);
    Settings settings = make_settings("backward_euler", 10.0);
    settings.solver.newton_tolerance = 1e-10;
    settings.solver.newton_iterations = 200;
    const auto simulation = make_simulation(model, settings, make_state(make_scrambled(model, 1)));
    double energy = calc_energy(*simulation);
    for (int i = 0; i < 8; ++i) {
      run(*simulation, 1);
      EXPECT_LE(calc_energy(*simulation), energy * (1.0 + 1e-12));
      energy = calc_energy(*simulation);
    }
    EXPECT_GT(simulation->calc_report().min_j.value(), 0.999);
    EXPECT_EQ(simulation->calc_report().inverted, 0);
  }
}

}  // namespace
}  // namespace flexcast::test
