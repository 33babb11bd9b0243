// Quasi-static steps: equilibria that have a closed form, free bodies that stay
// where they are, and honesty about what was not reached.
#include "core/integrators/quasi_static.h"

#include <gtest/gtest.h>

#include "core/lab/statics.h"
#include "tests/support/everything.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

constexpr double earth_gravity = 9.81;

Settings settings_of(double step) {
  Settings settings = make_settings("quasi_static", step);
  settings.solver.newton_tolerance = 1e-9;
  return settings;
}

Model make_chain(int links, double stiffness) {
  const Mesh mesh = make_rope(links, 1.0);
  Model model = make_spring_model(mesh.nodes, mesh.springs, {.stiffness = stiffness, .damping = 0.1}, 0.1);
  std::fill_n(model.fixed.begin(), 3, std::uint8_t{1});
  model.gravity = {0, 0, -earth_gravity};
  return model;
}

// Link k of n carries the weight of the n - k particles below: l = r (1 + (n -
// k) m g / k_s).
void expect_hanging(const Simulation& simulation, double tolerance) {
  const Model& model = simulation.model();
  const int links = static_cast<int>(model.springs.size());
  const double r = 1.0 / links;
  Vec3 expected = Vec3::Zero();
  for (int k = 0; k < links; ++k) {
    expected.z() -= r * (1.0 + (links - k) * 0.1 * earth_gravity / model.bodies[0].stiffness);
    EXPECT_LE((position(simulation, k + 1) - expected).norm(), tolerance) << k;
  }
}

// It starts stretched out level: a mechanism that has to swing down by a
// quarter turn.
TEST(QuasiStatic, AChainHangsAsTheClosedFormSays) {
  for (const double stiffness : {30.0, 1e3, 1e6}) {
    const Model model = make_chain(8, stiffness);
    Simulation simulation(model, settings_of(1.0), make_state(model.rest_positions), {});
    ASSERT_TRUE(solve_static(simulation)) << stiffness << ": " << simulation.statistics().residual;
    expect_hanging(simulation, 1e-7);
  }
}

TEST(QuasiStatic, SaysWhenItsIterationsWereTooFewAndGoesOnFromThere) {
  const Model model = make_chain(8, 1e3);
  Settings settings = settings_of(1.0);
  settings.solver.newton_iterations = 3;
  settings.solver.newton_tolerance = 1e-10;
  Simulation simulation(model, settings, make_state(model.rest_positions), {});
  run(simulation, 1);
  EXPECT_FALSE(simulation.statistics().converged);
  EXPECT_GT(simulation.statistics().residual, 1e-10);
  EXPECT_EQ(simulation.statistics().iterations, 3);
  int steps = 1;
  for (; steps < 200 && !simulation.statistics().converged; ++steps) run(simulation, 1);
  EXPECT_LT(steps, 200);
  EXPECT_LE(simulation.statistics().residual, 1e-10);
  expect_hanging(simulation, 1e-7);
  const VecX before = simulation.state().positions;
  run(simulation, 1);
  EXPECT_EQ(simulation.statistics().iterations, 0);
  EXPECT_EQ(simulation.state().positions, before);
}

// Nothing holds it: whatever it starts with, and under its weight, it stays,
// and relaxes to its rest shape.
TEST(QuasiStatic, FreeBodiesDoNotDriftOverAThousandSteps) {
  for (const std::string body : {"springs", "tet4", "tet10"}) {
    SCOPED_TRACE(body);
    const Mesh mesh = make_beam({2, 1, 1}, {0.4, 0.2, 0.2}), lattice = make_lattice({2, 1, 1}, {0.4, 0.2, 0.2});
    const Elastic elastic{.young = 1e4};
    Model model = body == "springs" ? make_spring_model(lattice.nodes, lattice.springs, {.stiffness = 50.0}, 0.1)
                  : body == "tet10" ? make_quadratic_model(mesh, elastic)
                                    : make_beam_model(mesh, elastic);
    model.gravity = {1, -2, -earth_gravity};
    SplitMix64 random(9);
    const VecX& rest = model.rest_positions;
    VecX v(rest.size());
    for (std::int64_t i = 0; i < model.particle_count(); ++i) {
      block3(v, i) = Vec3(1, 2, 3) + Vec3(5, -3, 2).cross(Vec3(block3(rest, i)));
    }
    const VecX x = rest + make_random_vector(random, rest.size(), 0.01);
    Simulation simulation(model, settings_of(1e-2), make_state(x, v), {});
    const Vec3 center = simulation.calc_body_reports()[0].center_of_mass;
    run(simulation, 5);
    const VecX settled = simulation.state().positions;
    EXPECT_LE((simulation.calc_body_reports()[0].center_of_mass - center).norm(), 1e-14);
    EXPECT_LE((settled - rest).cwiseAbs().maxCoeff(), 0.011);
    run(simulation, 995);
    EXPECT_LE((simulation.state().positions - settled).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_EQ(simulation.state().velocities.norm(), 0.0);
    EXPECT_LE(simulation.calc_report().elastic, 1e-10);
  }
}

// A dead load on a free body is carried by its inertia: the bar is stretched by
// half the pull at its middle.
TEST(QuasiStatic, AFreeBodyUnderALoadStretchesAsIfItAccelerated) {
  const Mesh mesh = make_rope(2, 2.0);
  Model model = make_spring_model(mesh.nodes, mesh.springs, {.stiffness = 100.0}, 1.0);
  model.external_forces = flatten({{0, 0, 0}, {0, 0, 0}, {3, 0, 0}});
  Simulation simulation(model, settings_of(1.0), make_state(model.rest_positions), {});
  run(simulation, 3);
  // 1 N moves each kilogram: the links carry 1 and 2 N.
  EXPECT_NEAR(position(simulation, 1).x() - position(simulation, 0).x(), 1.01, 1e-12);
  EXPECT_NEAR(position(simulation, 2).x() - position(simulation, 1).x(), 1.02, 1e-12);
  EXPECT_NEAR(position(simulation, 0).x() + position(simulation, 1).x() + position(simulation, 2).x(), 3.0, 1e-12);
}

TEST(QuasiStatic, ABodyRestsOnTheObstacleThatCarriesIt) {
  Model model = make_beam_model(make_beam({2, 2, 2}, {0.2, 0.2, 0.2}), {.young = 1e5});
  model.gravity = {0, 0, -earth_gravity};
  Obstacle ground;
  ground.name = "ground";
  model.obstacles = {ground};
  Simulation simulation(model, settings_of(1.0), make_state(model.rest_positions), {});
  ASSERT_TRUE(solve_static(simulation)) << simulation.statistics().residual;
  double push = 0.0;
  const System system(simulation.model());
  VecX all;
  for (const Force* force : system.active_forces()) {
    if (force->energy_kind() != EnergyKind::contact) continue;
    all = VecX::Zero(model.rest_positions.size());
    force->add_conservative(simulation.state().positions, all);
    for (std::int64_t i = 0; i < model.particle_count(); ++i) push += all[3 * i + 2];
  }
  EXPECT_NEAR(push, 8.0 * earth_gravity, 1e-6 * 8.0 * earth_gravity);
}

// What was moving has stopped: the books have to know where that went.
TEST(QuasiStatic, ClosesTheBooksAlsoWhenItStopsWhatMoved) {
  for (const char* integrator : {"quasi_static", "symplectic_euler"}) {
    const auto simulation = make(everything_text(integrator, 2e-4));
    const auto calc_balance = [&] {
      const StepReport r = simulation->calc_report();
      return r.kinetic + r.elastic + r.gravity + r.contact - r.work + r.dissipated - r.numerical;
    };
    const double start = calc_balance();
    run(*simulation, 5);
    const std::vector<ParameterAssignment> change = {{"time.integrator", std::string("quasi_static")}};
    ASSERT_TRUE(simulation->set_parameters(change).ok());
    run(*simulation, 5);
    const StepReport end = simulation->calc_report();
    EXPECT_NEAR(calc_balance(), start, 1e-10 * (std::abs(end.gravity) + std::abs(end.work) + end.dissipated));
    EXPECT_EQ(end.kinetic, 0.0);
    EXPECT_GT(end.dissipated, 0.0);
  }
}

}  // namespace
}  // namespace flexcast::test
