// Time, reset, reports and identity of a simulation.
#include "core/sim/simulation.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include "core/integrators/integrator.h"
#include "tests/support/model.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

// A clamped beam and a thrown damped rope under gravity.
std::string two_bodies(std::string_view integrator = "symplectic_euler", double step = 1e-3) {
  return concat("name = \"two\"\ngravity = [0, 0, -9.81]\n", time_table(integrator, step), R"(
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [3, 1, 1], size = [1.0, 0.3, 0.3] }
material = { law = "corotational", young = 2e4, poisson = 0.3, density = 500.0 }
damping = { mass = 0.1, stiffness = 1e-3 }
pin = [ { select = { box = [[0, 0, 0], [0, 1, 1]] } } ]
force = [ { select = { nodes = [3] }, value = [0, 2.0, 0] } ]
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [4], size = [1.0] }
springs = { stiffness = 30.0, damping = 0.2 }
mass = 0.05
drag = 0.01
velocity = [ { select = { all = true }, value = [1, 0, 2], spin = [0, 0, 3] } ]
)");
}

std::vector<std::uint64_t> run_hashes(Simulation& simulation, int steps) {
  std::vector<std::uint64_t> hashes = {simulation.calc_state_hash()};
  for (int i = 0; i < steps; ++i) {
    run(simulation, 1);
    hashes.push_back(simulation.calc_state_hash());
  }
  return hashes;
}

const char* const schemes[] = {"forward_euler", "symplectic_euler", "velocity_verlet", "rk4", "backward_euler"};

TEST(Simulation, SameSceneGivesTheSameBits) {
  for (const char* scheme : schemes) {
    EXPECT_EQ(run_hashes(*make(two_bodies(scheme)), 60), run_hashes(*make(two_bodies(scheme)), 60)) << scheme;
  }
}

TEST(Simulation, TimeIsTheStepCountTimesTheStepExactly) {
  const auto simulation = make(two_bodies("symplectic_euler", 1.1e-3));
  for (int k = 1; k <= 1000; ++k) {
    run(*simulation, 1);
    ASSERT_EQ(simulation->state().step, k);
    ASSERT_EQ(simulation->state().time, k * 1.1e-3);
  }
}

TEST(Simulation, SubstepsAreSmallerStepsOfTheSameScheme) {
  for (const char* scheme : schemes) {
    const auto coarse = make(two_bodies(scheme, 2e-3)), fine = make(two_bodies(scheme, 1e-3));
    ASSERT_TRUE(coarse->set_parameters(std::vector<ParameterAssignment>{{"time.substeps", std::int64_t{2}}}).ok());
    run(*coarse, 30);
    run(*fine, 60);
    EXPECT_EQ(coarse->state().positions, fine->state().positions) << scheme;
    EXPECT_EQ(coarse->state().velocities, fine->state().velocities) << scheme;
  }
}

TEST(Simulation, ResetReproducesTheBitsOfTheFirstRun) {
  for (const char* scheme : schemes) {
    const auto simulation = make(two_bodies(scheme));
    const auto first = run_hashes(*simulation, 50);
    simulation->reset();
    EXPECT_EQ(simulation->state().step, 0);
    EXPECT_EQ(simulation->state().time, 0.0);
    EXPECT_EQ(run_hashes(*simulation, 50), first) << scheme;
  }
}

TEST(Simulation, ResetRestoresOrKeepsParametersAsAsked) {
  const auto simulation = make(two_bodies());
  const auto first = run_hashes(*simulation, 40);
  const std::vector<ParameterAssignment> changes = {
      {"beam.young", 3e4}, {"gravity", Vec3(1, 0, 0)}, {"time.step", 5e-4}, {"time.integrator", "rk4"}};
  ASSERT_TRUE(simulation->set_parameters(changes).ok());
  run(*simulation, 10);
  simulation->reset(true);
  EXPECT_EQ(simulation->model().bodies[0].young, 3e4);
  EXPECT_EQ(simulation->settings().time.integrator, "rk4");
  const auto kept = run_hashes(*simulation, 40);
  EXPECT_EQ(kept[0], first[0]);
  EXPECT_NE(kept, first);
  const std::uint64_t revision = simulation->parameter_revision();
  simulation->reset(false);
  EXPECT_EQ(simulation->model().bodies[0].young, 2e4);
  EXPECT_EQ(simulation->model().gravity, Vec3(0, 0, -9.81));
  EXPECT_EQ(simulation->settings().time.step, 1e-3);
  EXPECT_EQ(simulation->settings().time.integrator, "symplectic_euler");
  EXPECT_GE(simulation->parameter_revision(), revision);
  EXPECT_EQ(run_hashes(*simulation, 40), first);
}

TEST(Simulation, HashIsXxh3OfStepPositionsAndVelocities) {
  const auto simulation = make(two_bodies());
  run(*simulation, 7);
  const State& state = simulation->state();
  std::vector<unsigned char> bytes;
  const auto append = [&](const void* data, std::size_t size) {
    const auto* first = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), first, first + size);
  };
  append(&state.step, sizeof state.step);
  append(state.positions.data(), sizeof(double) * static_cast<std::size_t>(state.positions.size()));
  append(state.velocities.data(), sizeof(double) * static_cast<std::size_t>(state.velocities.size()));
  EXPECT_EQ(simulation->calc_state_hash(), XXH3_64bits(bytes.data(), bytes.size()));
}

TEST(Simulation, StepAtIsTheNearestStepFromNowOn) {
  const auto simulation = make(two_bodies());
  EXPECT_EQ(simulation->step_at(0.0104), 10);
  EXPECT_EQ(simulation->step_at(0.0106), 11);
  run(*simulation, 10);
  EXPECT_EQ(simulation->step_at(0.02), 20);
  ASSERT_TRUE(simulation->set_parameters(std::vector<ParameterAssignment>{{"time.step", 5e-4}}).ok());
  EXPECT_EQ(simulation->step_at(0.02), 30);
  run(*simulation, 20);
  EXPECT_NEAR(simulation->state().time, 0.02, 1e-15);
}

TEST(Simulation, ReportIsThatOfTheState) {
  const auto simulation = make(two_bodies());
  run(*simulation, 25);
  const Model& model = simulation->model();
  const State& state = simulation->state();
  double kinetic = 0.0, gravity = 0.0;
  Vec3 momentum = Vec3::Zero(), angular_momentum = Vec3::Zero();
  for (std::int64_t i = 0; i < model.particle_count(); ++i) {
    const Vec3 x = block3(state.positions, i), v = block3(state.velocities, i);
    kinetic += 0.5 * model.masses[i] * v.squaredNorm();
    gravity -= model.masses[i] * model.gravity.dot(x);
    momentum += model.masses[i] * v;
    angular_momentum += model.masses[i] * x.cross(v);
  }
  const StepReport report = simulation->calc_report();
  EXPECT_EQ(report.step, 25);
  EXPECT_EQ(report.time, 25 * 1e-3);
  EXPECT_NEAR(report.kinetic, kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(report.gravity, gravity, 1e-12 * std::abs(gravity));
  EXPECT_LE((report.momentum - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LE((report.angular_momentum - angular_momentum).norm(), 1e-12 * angular_momentum.norm());
  EXPECT_EQ(report.inverted, 0);
  EXPECT_GT(report.min_j.value(), 0.5);
  EXPECT_LT(report.min_j.value(), 1.5);
}

double calc_balance(const StepReport& r) {
  return r.kinetic + r.elastic + r.gravity + r.contact - r.work + r.dissipated - r.numerical;
}

// Whatever the scheme, and when parameters change on the way.
TEST(Simulation, EnergiesCloseToRounding) {
  for (const IntegratorRow& row : integrators()) {
    if (row.name == "quasi_static") continue;  // relaxes by the trapezoidal rule of large steps
    SCOPED_TRACE(row.name);
    const auto simulation = make(two_bodies(std::string(row.name), 2e-4));
    const StepReport start = simulation->calc_report();
    run(*simulation, 500);
    ASSERT_TRUE(
        simulation
            ->set_parameters(std::vector<ParameterAssignment>{
                {"beam.young", 3e4}, {"beam.density", 700.0}, {"rope.stiffness", 50.0}, {"gravity", Vec3(1, 2, -3)}})
            .ok());
    run(*simulation, 500);
    const StepReport end = simulation->calc_report();
    EXPECT_GT(end.dissipated, 0.01);
    EXPECT_GT(std::abs(end.work), 0.01);
    EXPECT_NE(end.numerical, 0.0);
    const double scale = end.kinetic + end.elastic + end.dissipated + std::abs(end.gravity) + std::abs(end.work);
    EXPECT_NEAR(calc_balance(end), calc_balance(start), 1e-12 * scale);
  }
}

// The scheme's own gain or loss vanishes with its order.
TEST(Simulation, NumericalLossVanishesAtTheOrderOfTheScheme) {
  for (const IntegratorRow& row : integrators()) {
    if (row.order == 0) continue;
    SCOPED_TRACE(row.name);
    std::vector<double> losses;
    const double step = row.order == 4 ? 8e-4 : 2e-4;
    for (const double part : {1.0, 0.5, 0.25}) {
      const auto simulation = make(two_bodies(std::string(row.name), part * step));
      ASSERT_TRUE(
          simulation->set_parameters(std::vector<ParameterAssignment>{{"solver.newton_tolerance", 1e-13}}).ok());
      run(*simulation, static_cast<int>(std::lround(0.1 / (part * step))));
      losses.push_back(std::abs(simulation->calc_report().numerical));
    }
    EXPECT_NEAR(std::log2(losses[0] / losses[1]), row.order, 0.35) << losses[0];
    EXPECT_NEAR(std::log2(losses[1] / losses[2]), row.order, 0.35) << losses[1];
  }
}

TEST(Simulation, BodyReportsAreThoseOfEachBody) {
  const auto simulation = make(two_bodies());
  const auto reports = simulation->calc_body_reports();
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(reports[0].name, "beam");
  EXPECT_EQ(reports[0].particles, 16);
  EXPECT_EQ(reports[0].elements, 18);
  EXPECT_NEAR(reports[0].min_j.value(), 1.0, 1e-14);
  EXPECT_LE((reports[0].center_of_mass - Vec3(0.5, 0.15, 0.15)).norm(), 1e-14);
  EXPECT_EQ(reports[1].particles, 5);
  EXPECT_EQ(reports[1].elements, 4);
  EXPECT_FALSE(reports[1].min_j.has_value());
  EXPECT_LE((reports[1].center_of_mass - Vec3(0.5, 0, 0)).norm(), 1e-15);
}

TEST(Simulation, ImplicitStepsAgreeWhateverTheLinearSolver) {
  const auto direct = make(two_bodies("backward_euler")), iterative = make(two_bodies("backward_euler"));
  ASSERT_TRUE(iterative
                  ->set_parameters(
                      std::vector<ParameterAssignment>{{"solver.linear", "pcg"}, {"solver.linear_tolerance", 1e-10}})
                  .ok());
  run(*direct, 50);
  run(*iterative, 50);
  EXPECT_GT(iterative->statistics().linear_iterations, 0);
  EXPECT_LE((direct->state().positions - iterative->state().positions).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Simulation, ImplicitStepsReportConvergence) {
  const auto simulation = make(two_bodies("backward_euler"));
  ASSERT_TRUE(simulation->set_parameters(std::vector<ParameterAssignment>{{"solver.newton_tolerance", 1e-9}}).ok());
  for (int i = 0; i < 20; ++i) {
    run(*simulation, 1);
    EXPECT_TRUE(simulation->statistics().converged);
    EXPECT_LE(simulation->statistics().residual, 1e-9);
    EXPECT_GE(simulation->statistics().iterations, 1);
  }
}

// The step's equation is linear there, damping and all, so one iteration with the right matrix solves it.
TEST(Simulation, ImplicitStepsOfALinearBodyTakeOneIteration) {
  std::string text = two_bodies("backward_euler");
  text.replace(text.find("corotational"), 12, "linear");
  text.erase(text.rfind("[[body]]"));
  const auto simulation = make(text);
  ASSERT_TRUE(simulation
                  ->set_parameters(std::vector<ParameterAssignment>{{"solver.newton_tolerance", 1e-10},
                                                                    {"beam.damping.stiffness", 0.02}})
                  .ok());
  for (int i = 0; i < 10; ++i) {
    run(*simulation, 1);
    EXPECT_EQ(simulation->statistics().iterations, 1);
    EXPECT_TRUE(simulation->statistics().converged);
  }
}

TEST(Simulation, LockingIsWarnedOfFromPoissonPointFourFiveOn) {
  const auto simulation = make(two_bodies());
  EXPECT_TRUE(simulation->calc_warnings().empty());
  ASSERT_TRUE(simulation->set_parameters(std::vector<ParameterAssignment>{{"beam.poisson", 0.45}}).ok());
  ASSERT_FALSE(simulation->calc_warnings().empty());
  EXPECT_NE(simulation->calc_warnings().back().find("beam"), std::string::npos);
}

}  // namespace
}  // namespace flexcast::test
