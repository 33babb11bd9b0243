// Extended position-based dynamics: converged it is backward Euler where
// constraints have its energy, small steps stand in for sweeps, momentum is
// kept.
#include "core/integrators/xpbd.h"

#include <gtest/gtest.h>

#include "tests/support/model.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

Model make_net(double damping = 0.0) {
  const Mesh mesh = make_grid({2, 2}, {0.4, 0.4});
  Model model = make_spring_model(mesh.nodes, mesh.springs, {.stiffness = 20.0, .damping = damping}, 0.05);
  model.gravity = {0, 0, -9.81};
  std::fill_n(model.fixed.begin(), 3, std::uint8_t{1});
  return model;
}

Simulation make_run(const Model& model, std::string_view scheme, double h, int sweeps) {
  SplitMix64 random(31);
  VecX v = make_random_vector(random, model.rest_positions.size(), 0.3);
  Settings settings = make_settings(std::string(scheme), h);
  settings.solver.iterations = sweeps;
  return {model, settings, make_state(model.rest_positions, v), {}};
}

double calc_distance(const Simulation& a, const Simulation& b) {
  return (a.state().positions - b.state().positions).cwiseAbs().maxCoeff();
}

TEST(Xpbd, WithManySweepsIsBackwardEulerOfSpringsContactAndGrabs) {
  Model model = make_net();
  Obstacle ball;
  ball.name = "ball";
  ball.shape = Obstacle::Shape::sphere;
  ball.center = {0.25, 0.2, -0.3};
  ball.radius = 0.3;
  model.obstacles = {ball};
  model.grabs = {{8, Vec3(0.4, 0.4, 0.2), 30.0}};
  model.bodies[0].drag = 0.05;
  model.bodies[0].mass_damping = 0.5;
  // Not quite: what earlier sweeps did along directions that have turned since
  // stays. That vanishes with the step.
  double last = 1.0;
  for (const double h : {8e-3, 4e-3, 2e-3, 1e-3}) {
    Simulation sweeps = make_run(model, "xpbd", h, 2000), newton = make_run(model, "backward_euler", h, 1);
    run(sweeps, 1);
    run(newton, 1);
    const double distance = calc_distance(sweeps, newton);
    EXPECT_LT(distance, last / 6.0) << h;
    last = distance;
  }
  EXPECT_LT(last, 1e-8);
}

TEST(Xpbd, DampsSpringsLikeBackwardEuler) {
  Simulation sweeps = make_run(make_net(0.3), "xpbd", 2e-3, 2000),
             newton = make_run(make_net(0.3), "backward_euler", 2e-3, 1);
  run(sweeps, 100);
  run(newton, 100);
  EXPECT_LE(calc_distance(sweeps, newton), 1e-3);
}

// Small steps: one sweep each, and the way taken goes to that of exact dynamics
// as the step does to zero.
TEST(Xpbd, OneSweepOfSmallStepsConverges) {
  Simulation exact = make_run(make_net(), "rk4", 1e-4, 1);
  run(exact, 2000);
  double last = 1.0;
  for (const double h : {1e-3, 5e-4, 2.5e-4}) {
    Simulation simulation = make_run(make_net(), "xpbd", h, 1);
    run(simulation, static_cast<int>(std::lround(0.2 / h)));
    const double error = calc_distance(simulation, exact);
    EXPECT_LT(error, 0.6 * last) << h;
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

// Its tetrahedra go to backward Euler's too as steps get small.
TEST(Xpbd, TetrahedraConvergeWithSmallSteps) {
  for (const bool quadratic : {false, true}) {
    const Mesh mesh = make_beam({2, 1, 1}, {0.4, 0.2, 0.2});
    for (const char* law : {"corotational", "neo_hookean"}) {
      const Elastic elastic{.law = law, .young = 2e4};
      Model model = quadratic ? make_quadratic_model(mesh, elastic) : make_beam_model(mesh, elastic);
      model.gravity = {0, 0, -9.81};
      std::fill_n(model.fixed.begin(), 3, std::uint8_t{1});
      const double h = 2e-4;
      Simulation sweeps = make_run(model, "xpbd", h, 20), newton = make_run(model, "backward_euler", h, 1);
      run(sweeps, 250);
      run(newton, 250);
      const double moved = (newton.state().positions - model.rest_positions).cwiseAbs().maxCoeff();
      EXPECT_LE(calc_distance(sweeps, newton), 0.02 * moved) << law << quadratic;
    }
  }
}

TEST(Xpbd, TellsHowFarFromConvergedItIs) {
  double last = 1.0;
  for (const int sweeps : {1, 8, 64, 512}) {
    Simulation simulation = make_run(make_net(), "xpbd", 5e-3, sweeps);
    run(simulation, 1);
    EXPECT_LE(simulation.statistics().residual, last * (1 + 1e-4)) << sweeps;
    EXPECT_FALSE(simulation.statistics().converged);
    last = simulation.statistics().residual;
  }
}

}  // namespace
}  // namespace flexcast::test
