// Handles: particles that move as prescribed, what they put into a body, and
// what they exert on it.
#include "core/forces/handle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/integrators/integrator.h"
#include "core/lab/statics.h"
#include "tests/support/everything.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

using Assignments = std::vector<ParameterAssignment>;

Handle make_handle(const Model& model, std::string name, std::vector<std::int32_t> particles) {
  Handle handle;
  handle.name = std::move(name);
  handle.particles = std::move(particles);
  for (const std::int32_t particle : handle.particles) {
    handle.base.push_back(block3(model.rest_positions, particle));
    handle.about += handle.base.back() / static_cast<double>(handle.particles.size());
  }
  return handle;
}

// A damped lattice held by four particles that turn and move from 0.02 s to
// 0.05 s.
Model make_moved_lattice(double duration) {
  const Mesh mesh = make_lattice({2, 2, 2}, {0.2, 0.2, 0.2});
  Model model = make_spring_model(mesh.nodes, mesh.springs, {.stiffness = 20.0, .damping = 0.05}, 0.02);
  model.gravity = {0, 0, -9.81};
  model.handles.push_back(make_handle(model, "grip", {0, 1, 3, 4}));
  model.handles[0].translate = {0.1, -0.05, 0.2};
  model.handles[0].rotate = {1.0, 2.0, -0.5};
  model.handles[0].about = {0.3, 0.1, 0.0};
  model.handles[0].start = 0.02;
  model.handles[0].duration = duration;
  return model;
}

Simulation make_simulation(const Model& model, std::string_view integrator, double step) {
  Settings settings = make_settings(std::string(integrator), step);
  settings.solver.newton_tolerance = 1e-11;
  return {model, settings, make_state(model.rest_positions), {}};
}

class HandleOf : public testing::TestWithParam<IntegratorRow> {
 protected:
  const std::string scheme_{GetParam().name};
  bool is_dynamic() const { return scheme_ != "quasi_static"; }
};

TEST_P(HandleOf, MovesItsParticlesAsPrescribedAtEveryStep) {
  const Model model = make_moved_lattice(0.03);
  const Handle& handle = model.handles[0];
  Simulation simulation = make_simulation(model, scheme_, 1e-3);
  for (int k = 1; k <= 70; ++k) {
    run(simulation, 1);
    const double t = simulation.state().time, a = std::clamp((t - 0.02) / 0.03, 0.0, 1.0);
    const bool moves = t >= 0.02 - 1e-9 && t < 0.05 - 1e-9;
    const Mat3 R = make_rotation(handle.rotate, a * handle.rotate.norm());
    for (std::size_t i = 0; i < handle.particles.size(); ++i) {
      const Vec3 arm = R * (handle.base[i] - handle.about);
      EXPECT_LE((position(simulation, handle.particles[i]) - (handle.about + arm + a * handle.translate)).norm(), 1e-14)
          << k;
      const Vec3 v = moves && is_dynamic() ? Vec3((handle.translate + handle.rotate.cross(arm)) / 0.03) : Vec3::Zero();
      EXPECT_LE((velocity(simulation, handle.particles[i]) - v).norm(), 1e-12 * (1.0 + v.norm())) << k;
    }
  }
}

TEST_P(HandleOf, WithoutDurationJumpsAtItsStartAndRests) {
  const Model model = make_moved_lattice(0.0);
  const Handle& handle = model.handles[0];
  Simulation simulation = make_simulation(model, scheme_, 1e-3);
  for (int k = 1; k <= 40; ++k) {
    run(simulation, 1);
    for (std::size_t i = 0; i < handle.particles.size(); ++i) {
      const Mat3 R = k < 20 ? Mat3(Mat3::Identity()) : make_rotation(handle.rotate, handle.rotate.norm());
      const Vec3 x = handle.about + R * (handle.base[i] - handle.about) + (k < 20 ? 0.0 : 1.0) * handle.translate;
      EXPECT_LE((position(simulation, handle.particles[i]) - x).norm(), 1e-14) << k;
      EXPECT_EQ(velocity(simulation, handle.particles[i]), Vec3(0, 0, 0)) << k;
    }
  }
}

// With moves, a jump, and changes of every handle parameter on the way.
TEST_P(HandleOf, ClosesTheBooksWithItsWork) {
  const auto simulation = make(everything_text(scheme_, 2e-4));
  const auto calc_balance = [&] {
    const StepReport r = simulation->calc_report();
    return r.kinetic + r.elastic + r.gravity + r.contact - r.work + r.dissipated - r.numerical;
  };
  const double start = calc_balance();
  const auto expect_closed = [&](const char* when) {
    const StepReport r = simulation->calc_report();
    const double scale = r.kinetic + r.elastic + r.dissipated + std::abs(r.gravity) + std::abs(r.work);
    EXPECT_NEAR(calc_balance(), start, 1e-10 * scale) << when;
  };
  run(*simulation, 50);
  expect_closed("moving");
  run(*simulation, 60);
  expect_closed("after the jump");
  for (const ParameterAssignment& change : Assignments{{"handle.grip.translate", Vec3(0, 0.1, 0.2)},
                                                       {"handle.grip.rotate", Vec3(0, 0.5, 0)},
                                                       {"handle.grip.about", Vec3(0.1, 0, 0.1)},
                                                       {"handle.grip.duration", 0.03},
                                                       {"handle.grip.start", 0.01},
                                                       {"handle.jump.translate", Vec3(0, 0, 0.03)},
                                                       {"handle.jump.start", 0.1}}) {
    ASSERT_TRUE(simulation->set_parameters(Assignments{change}).ok());
    expect_closed(change.name.c_str());
    run(*simulation, 10);
    expect_closed(change.name.c_str());
  }
  EXPECT_GT(std::abs(simulation->calc_report().work), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(EveryScheme, HandleOf, testing::ValuesIn(integrators().begin(), integrators().end()),
                         [](const auto& row) { return std::string(row.param.name); });

// The work is that of the force against which a handle moves: a spring
// stretched slowly stores all of it.
TEST(Handle, WorkOfASlowPullIsTheEnergyOfTheSpring) {
  for (const IntegratorRow& row : integrators()) {
    Model model = make_spring_model({{0, 0, 0}, {1, 0, 0}}, {{0, 1}}, {.stiffness = 100.0, .damping = 5.0}, 1e-3);
    std::fill_n(model.fixed.begin(), 3, std::uint8_t{1});
    model.handles.push_back(make_handle(model, "grip", {1}));
    model.handles[0].translate = {0.2, 0, 0};
    model.handles[0].duration = 10.0;
    Simulation simulation = make_simulation(model, row.name, 1e-2);
    run(simulation, 1001);
    // The damper takes k_d v^2 T / r = 0.02 J of it; without inertia none acts.
    const double damped = row.name == "quasi_static" ? 0.0 : 5.0 * 0.02 * 0.02 * 10.0;
    const StepReport report = simulation.calc_report();
    EXPECT_NEAR(report.elastic, 0.5 * 100.0 * 0.2 * 0.2, 1e-12);
    // The books of a step take mean velocities, also where the handle stops: h
    // F v.
    EXPECT_NEAR(report.work, 2.0 + damped, 1.1 * 1e-2 * 20.0 * 0.02) << row.name;
    EXPECT_NEAR(report.dissipated, damped, 1e-3 * damped + 1e-6) << row.name;
    EXPECT_NEAR(simulation.calc_handle_reports()[0].force.x(), 20.0, 1e-10) << row.name;
  }
}

std::vector<std::int32_t> select(const Mesh& mesh, double x) {
  std::vector<std::int32_t> nodes;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (std::abs(mesh.nodes[i].x() - x) < 1e-9) nodes.push_back(static_cast<std::int32_t>(i));
  }
  return nodes;
}

TEST(HandleReaction, OfAStretchedBarIsModulusTimesAreaTimesStrain) {
  const Mesh mesh = make_beam({6, 2, 2}, {1.0, 0.2, 0.1});
  for (const char* law : {"linear", "corotational"}) {
    Model model = make_beam_model(mesh, {.law = law, .young = 1e5, .poisson = 0.0});
    model.handles = {make_handle(model, "left", select(mesh, 0.0)), make_handle(model, "right", select(mesh, 1.0))};
    model.handles[1].translate = {0.01, 0, 0};
    Simulation simulation = make_simulation(model, "symplectic_euler", 1e-3);
    ASSERT_TRUE(solve_static(simulation));
    const auto reports = simulation.calc_handle_reports();
    EXPECT_LE((reports[1].force - Vec3(1e5 * 0.02 * 0.01, 0, 0)).norm(), 1e-9 * 20.0) << law;
    EXPECT_LE((reports[0].force + reports[1].force).norm(), 1e-9 * 20.0) << law;
    EXPECT_LE(reports[0].torque.norm() + reports[1].torque.norm(), 1e-8) << law;
  }
}

TEST(HandleReaction, OfAHangingBodyIsItsWeight) {
  const Mesh mesh = make_beam({4, 1, 1}, {0.4, 0.1, 0.1});
  Model model = make_quadratic_model(mesh, {.young = 1e5, .density = 1000.0});
  model.gravity = {0, 0, -9.81};
  model.handles = {make_handle(model, "wall", select(mesh, 0.0))};
  Simulation simulation = make_simulation(model, "backward_euler", 1e-3);
  ASSERT_TRUE(solve_static(simulation));
  const auto report = simulation.calc_handle_reports()[0];
  EXPECT_LE((report.force - Vec3(0, 0, 4.0 * 9.81)).norm(), 1e-8 * 39.0);
  // About the wall's middle: mass times lever arm of the sagging bar.
  const Vec3 arm = simulation.calc_body_reports()[0].center_of_mass - model.handles[0].about;
  EXPECT_LE((report.torque - arm.cross(Vec3(0, 0, 4.0 * 9.81))).norm(), 1e-8 * 8.0);
}

TEST(HandleReaction, TorquesOfATwistedBarAreOpposite) {
  const Mesh mesh = make_beam({8, 2, 2}, {1.0, 0.2, 0.2});
  Model model = make_beam_model(mesh, {.law = "neo_hookean", .young = 1e5});
  model.handles = {make_handle(model, "left", select(mesh, 0.0)), make_handle(model, "right", select(mesh, 1.0))};
  model.handles[1].rotate = {1.5, 0, 0};
  Simulation simulation = make_simulation(model, "symplectic_euler", 1e-3);
  ASSERT_TRUE(solve_static(simulation));
  const auto reports = simulation.calc_handle_reports();
  const double torque = reports[1].torque.x();
  EXPECT_GT(torque, 1.0);
  EXPECT_NEAR(reports[0].torque.x(), -torque, 1e-8 * torque);
  const double axial = reports[1].force.norm();
  EXPECT_LE((reports[0].force + reports[1].force).norm(), 1e-8 * (torque + axial));
}

// d(momentum)/dt = weight + drag + what the handle exerts; so long as the
// handle moves evenly also step by step.
TEST(HandleReaction, IsTheRateOfMomentum) {
  Model model = make_moved_lattice(1.0);
  model.handles[0].start = 0.0;
  model.bodies[0].drag = 0.01;
  for (const bool turns : {false, true}) {
    model.handles[0].rotate = turns ? Vec3(1.0, 2.0, -0.5) : Vec3(0, 0, 0);
    const double h = turns ? 1e-5 : 1e-3;
    const double tolerance = turns ? 1e-5 : 1e-10;  // turning: the trapezoidal rule's
    Simulation simulation = make_simulation(model, turns ? "rk4" : "symplectic_euler", h);
    const auto calc_rate = [&] {
      Vec3 rate = simulation.calc_handle_reports()[0].force;
      for (std::int64_t i = 0; i < model.particle_count(); ++i) {
        rate += simulation.model().masses[i] * model.gravity - 0.01 * velocity(simulation, i);
      }
      return rate;
    };
    run(simulation, 100);
    for (int k = 0; k < 50; ++k) {
      const Vec3 before = simulation.calc_report().momentum;
      Vec3 rate = calc_rate();
      run(simulation, 1);
      if (turns) rate = 0.5 * (rate + calc_rate());
      EXPECT_LE((simulation.calc_report().momentum - before - h * rate).norm(), tolerance * h * rate.norm()) << k;
    }
  }
}

}  // namespace
}  // namespace flexcast::test
