// Vertex block descent: with enough sweeps it is backward Euler, with few it is
// stable at any step.
#include "core/integrators/vbd.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/support/model.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

struct DescentCase {
  std::string name;
  std::function<Model()> make;
};

Model make_springs() {
  const Mesh mesh = make_lattice({1, 1, 1}, {0.3, 0.3, 0.3});
  return make_spring_model(mesh.nodes, mesh.springs, {.stiffness = 40.0, .damping = 0.0}, 0.1);
}
Model make_tet4(std::string_view law = "corotational") {
  return make_beam_model(make_beam({2, 1, 1}, {0.4, 0.2, 0.2}), {.law = law, .young = 2e4});
}
Model make_tet10() {
  return make_quadratic_model(make_beam({1, 1, 1}, {0.2, 0.2, 0.2}), {.law = "neo_hookean", .young = 2e4});
}
Model with_contact(double friction) {
  Model model = make_tet4();
  model.gravity = {3, 0, -9.81};
  Obstacle ground;
  ground.name = "ground";
  ground.point = {0, 0, 0.01};
  ground.friction = friction;
  model.obstacles = {ground};
  return model;
}
Model with_damping(Model model) {
  model.bodies[0].drag = 0.3;
  model.bodies[0].mass_damping = 0.4;
  (model.bodies[0].is_fem() ? model.bodies[0].stiffness_damping : model.bodies[0].damping) = 5e-3;
  return model;
}
Model with_handle_and_pin() {
  Model model = make_tet4();
  model.gravity = {0, 0, -9.81};
  for (int axis = 0; axis < 2; ++axis) model.fixed[static_cast<std::size_t>(axis)] = 1;
  Handle handle;
  handle.name = "grip";
  handle.particles = {2, 5};
  for (const std::int32_t particle : handle.particles) handle.base.push_back(block3(model.rest_positions, particle));
  handle.translate = {0.1, 0.1, 0.2};
  handle.rotate = {0, 1, 0};
  handle.duration = 0.1;
  model.handles = {handle};
  model.grabs = {{7, Vec3(0.3, 0.3, 0.3), 50.0}};
  return model;
}

std::vector<DescentCase> descent_cases() {
  return {{"springs", make_springs},
          {"damped_springs", [] { return with_damping(make_springs()); }},
          {"tet4", [] { return make_tet4(); }},
          {"linear_tet4", [] { return make_tet4("linear"); }},
          {"damped_tet4", [] { return with_damping(make_tet4()); }},
          {"tet10", make_tet10},
          {"damped_tet10", [] { return with_damping(make_tet10()); }},
          {"contact", [] { return with_contact(0.0); }},
          {"handle_and_pin", with_handle_and_pin}};
}

class VbdCase : public testing::TestWithParam<DescentCase> {
 protected:
  // Bent, spinning: not a state where anything is linear.
  Simulation make_run(std::string_view scheme, double h, int sweeps) const {
    Model model = GetParam().make();
    SplitMix64 random(31);
    const Eigen::Index size = model.rest_positions.size();
    State start = make_state(model.rest_positions + make_random_vector(random, size, 0.01),
                             make_random_vector(random, size, 0.3));
    for (Eigen::Index i = 0; i < size; ++i) {
      if (model.fixed[static_cast<std::size_t>(i)]) start.positions[i] = model.rest_positions[i];
    }
    Settings settings = make_settings(std::string(scheme), h);
    settings.solver.iterations = sweeps;
    return {std::move(model), settings, start, {}};
  }
};

TEST_P(VbdCase, WithManySweepsIsBackwardEuler) {
  const double h = 5e-3;
  Simulation descent = make_run("vbd", h, 1500), newton = make_run("backward_euler", h, 1);
  for (int k = 0; k < 4; ++k) {
    run(descent, 1);
    run(newton, 1);
    EXPECT_LE((descent.state().positions - newton.state().positions).cwiseAbs().maxCoeff(), 1e-9) << k;
    EXPECT_LE((descent.state().velocities - newton.state().velocities).cwiseAbs().maxCoeff(), 1e-8) << k;
    EXPECT_LE(descent.statistics().residual, 1e-8);
  }
}

TEST_P(VbdCase, SweepsDescend) {
  double last = 1.0;
  for (const int sweeps : {1, 4, 16, 64}) {
    Simulation simulation = make_run("vbd", 5e-3, sweeps);
    run(simulation, 1);
    const double residual = simulation.statistics().residual;
    EXPECT_TRUE(residual < last || residual < 1e-13) << sweeps << ": " << residual;
    EXPECT_EQ(simulation.statistics().iterations, sweeps);
    EXPECT_EQ(simulation.statistics().converged, residual <= 1e-14);
    last = residual;
  }
}

INSTANTIATE_TEST_SUITE_P(Everything, VbdCase, testing::ValuesIn(descent_cases()),
                         [](const auto& row) { return row.param.name; });

// Normal forces of friction are those of the step's start here: what differs
// from backward Euler is of first order.
TEST(Vbd, WithFrictionApproachesBackwardEuler) {
  const Model model = with_contact(0.4);
  VecX ends[2];
  for (int i = 0; i < 2; ++i) {
    Settings settings = make_settings(i == 0 ? "vbd" : "backward_euler", 2e-4);
    settings.solver.iterations = 100;
    settings.solver.newton_tolerance = 1e-10;
    Simulation simulation(model, settings, make_state(model.rest_positions), {});
    run(simulation, 500);
    ends[i] = simulation.state().positions;
  }
  EXPECT_LE((ends[0] - ends[1]).cwiseAbs().maxCoeff(), 1e-3 * (ends[1] - model.rest_positions).cwiseAbs().maxCoeff());
}

// A beam as stiff as rubber is to steel, steps a thousand times what explicit
// schemes could take.
TEST(FastSchemes, StayStableAtHugeStepsOnStiffBodies) {
  for (const char* scheme : {"vbd", "xpbd"}) {
    for (const bool springs : {false, true}) {
      const Mesh lattice = make_lattice({4, 2, 2}, {1.0, 0.5, 0.5});
      Model model = springs ? make_spring_model(lattice.nodes, lattice.springs, {.stiffness = 1e8}, 1.0)
                            : make_beam_model(make_beam({4, 2, 2}, {1.0, 0.5, 0.5}), {.young = 1e9});
      model.gravity = {0, 0, -9.81};
      std::fill_n(model.fixed.begin(), 3, std::uint8_t{1});
      VecX v = VecX::Zero(model.rest_positions.size());
      SplitMix64 random(4);
      for (std::int64_t i = 1; i < model.particle_count(); ++i) block3(v, i) = make_random_vector(random, 5.0);
      Simulation simulation(model, make_settings(scheme, 0.1), make_state(model.rest_positions, v), {});
      const StepReport start = simulation.calc_report();
      const double fall = simulation.model().masses.sum() * 9.81 * 2.0;  // as far as it can swing
      for (int k = 0; k < 200; ++k) {
        ASSERT_TRUE(simulation.step()) << scheme << " " << simulation.failure()->text();
        const StepReport report = simulation.calc_report();
        if (scheme == std::string("xpbd")) continue;  // finite is all it promises
        ASSERT_LE(report.kinetic + report.elastic, 2.0 * (start.kinetic + fall)) << scheme << k << springs;
      }
    }
  }
}

}  // namespace
}  // namespace flexcast::test
