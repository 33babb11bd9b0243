// What every row of the table of integrators must keep: its order of convergence, the momentum of free bodies, held
// particles, the same bits for the same input, and the stability limit it advertises.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "core/integrators/integrator.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

SolverSettings tight() {
  return make_settings("", 1.0).solver;
}

class SchemeKit : public testing::TestWithParam<IntegratorRow> {
 protected:
  const IntegratorRow& row_ = GetParam();

  // One integrator for all steps.
  void run(Model model, State& state, double h, int steps) const {
    update_masses(model);
    const System system(model);
    const auto integrator = row_.make(system, tight());
    StepStatistics statistics;
    for (int i = 0; i < steps; ++i) {
      integrator->step(system, h, state, statistics);
      state.time += h;
    }
  }

  // Schemes that know no time have no velocities; no order, no momentum to keep.
  bool is_dynamic() const { return row_.name != "quasi_static"; }
  // Iterates until it has solved its equations, or for a fixed number of times?
  bool is_solved() const { return row_.order > 0; }
};

// A pair of 1 kg and 3 kg on a damped spring, turning and oscillating.
Model make_orbit(double damping) {
  Model model = make_spring_model({{0, 0, 0}, {1, 0, 0}}, {{0, 1}}, {.stiffness = 100.0, .damping = damping}, 1.0);
  model.bodies[0].mass_overrides = {{1, 3.0}};
  return model;
}
State orbit_start() {
  return make_state(flatten({{0, 0, 0}, {1.5, 0, 0}}), flatten({{0, 0.5, 0}, {0.2, -1, 0}}));
}

// A damped block of springs and a damped elastic beam, both thrown and spinning freely.
Model make_lattice_model() {
  const Mesh mesh = make_lattice({2, 2, 1}, {1.0, 1.0, 0.5});
  return make_spring_model(mesh.nodes, mesh.springs, {.stiffness = 60.0, .damping = 0.5}, 0.1);
}
Model make_fem_model(std::string_view law = "corotational") {
  Model model = make_beam_model(make_beam({2, 1, 1}, {1.0, 0.5, 0.5}), {.law = law, .young = 2e4});
  model.bodies[0].stiffness_damping = 2e-3;
  return model;
}
State thrown(const Model& model, std::uint64_t seed) {
  SplitMix64 random(seed);
  const Eigen::Index size = model.rest_positions.size();
  State state =
      make_state(model.rest_positions + make_random_vector(random, size, 0.05), make_random_vector(random, size, 1.0));
  for (std::int64_t i = 0; i < size / 3; ++i) {
    block3(state.velocities, i) += Vec3(2, -1, 0.5) + Vec3(0, 0, 1).cross(Vec3(block3(state.positions, i)));
  }
  return state;
}

TEST_P(SchemeKit, ConvergesWithItsOrderAlsoWithDamping) {
  if (!is_dynamic()) return;
  const int order = std::max(row_.order, 1);  // what iterates is backward Euler here, where a spring is solved at once
  const double window = order == 1 ? 0.1 : order == 2 ? 0.15 : 0.5;
  const double h = order == 1 ? 5e-4 : order == 2 ? 2e-3 : 4e-3;
  for (const double damping : {0.0, 0.7}) {
    std::vector<VecX> ends;
    for (int level = 0; level < 4; ++level) {
      State state = orbit_start();
      const double step = std::ldexp(h, -level);
      run(make_orbit(damping), state, step, static_cast<int>(std::lround(1.0 / step)));
      ends.push_back(state.positions);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const double ratio = (ends[i] - ends[i + 1]).norm() / (ends[i + 1] - ends[i + 2]).norm();
      EXPECT_NEAR(std::log2(ratio), order, window) << "k_d=" << damping << " h=" << std::ldexp(h, -static_cast<int>(i));
    }
  }
}

TEST_P(SchemeKit, KeepsTheMomentumOfFreeBodiesWithInternalDamping) {
  if (!is_dynamic()) return;
  // Position-based schemes divide rounding by the step.
  const double tolerance = is_solved() ? 1e-13 : 1e-10;
  for (Model model : {make_lattice_model(), make_fem_model(), make_fem_model("linear")}) {
    update_masses(model);
    State state = thrown(model, 21);
    const auto calc_momentum = [&] {
      Vec3 momentum = Vec3::Zero();
      for (std::int64_t i = 0; i < model.particle_count(); ++i)
        momentum += model.masses[i] * block3(state.velocities, i);
      return momentum;
    };
    const Vec3 before = calc_momentum();
    const VecX v = state.velocities;
    run(model, state, 1e-3, 200);
    EXPECT_LE((calc_momentum() - before).norm(), tolerance * before.norm());
    EXPECT_GT((state.velocities - v).norm(), 0.1);
  }
}

// A scheme of several steps hands its history on.
TEST_P(SchemeKit, GivesTheSameBitsTwiceAndRemembersNothingButItsHistory) {
  for (Model model : {make_lattice_model(), make_fem_model()}) {
    update_masses(model);
    const State start = thrown(model, 22);
    State once = start, twice = start, forgetful = start;
    run(model, once, 1e-3, 50);
    run(model, twice, 1e-3, 50);
    VecX history;
    const System system(model);
    for (int i = 0; i < 50; ++i) {
      const auto integrator = row_.make(system, tight());
      integrator->set_history(history);
      StepStatistics statistics;
      integrator->step(system, 1e-3, forgetful, statistics);
      forgetful.time += 1e-3;
      history = integrator->history();
    }
    EXPECT_EQ(once.positions, twice.positions);
    EXPECT_EQ(once.velocities, twice.velocities);
    EXPECT_EQ(once.positions, forgetful.positions);
    EXPECT_EQ(once.velocities, forgetful.velocities);
  }
}

TEST_P(SchemeKit, ForgetsWhatItIsToldIsVoid) {
  Model model = make_fem_model();
  update_masses(model);
  State state = thrown(model, 24);
  System system(model);
  const auto integrator = row_.make(system, tight());
  StepStatistics statistics;
  for (int i = 0; i < 10; ++i) integrator->step(system, 1e-3, state, statistics);
  model.bodies[0].young *= 2.0;
  system.refresh();
  state = thrown(model, 25);
  integrator->invalidate();
  State fresh = state;
  for (int i = 0; i < 10; ++i) integrator->step(system, 1e-3, state, statistics);
  run(model, fresh, 1e-3, 10);
  EXPECT_EQ(state.positions, fresh.positions);
  EXPECT_EQ(state.velocities, fresh.velocities);
}

TEST_P(SchemeKit, LeavesHeldParticlesWhereTheyAre) {
  Model model = make_fem_model();
  model.gravity = {0, 0, -9.81};
  model.bodies[0].drag = 0.1;
  for (const std::size_t dof : {0, 1, 2, 9, 10, 11, 14}) model.fixed[dof] = 1;
  State state = thrown(model, 23);
  for (const Eigen::Index dof : {0, 1, 2, 9, 10, 11, 14}) state.velocities[dof] = 0.0;
  const State start = state;
  run(model, state, 1e-3, 20);
  for (const Eigen::Index dof : {0, 1, 2, 9, 10, 11, 14}) {
    EXPECT_EQ(state.positions[dof], start.positions[dof]);
    EXPECT_EQ(state.velocities[dof], 0.0);
  }
  EXPECT_NE(state.positions[12], start.positions[12]);
}

// A mode of frequency omega and damping ratio zeta: one mass on a spring along x.
struct Mode {
  double omega, zeta;

  Model make_model() const {
    const double mass = 0.2, r = 0.5;
    Model model =
        make_spring_model({{0, 0, 0}, {r, 0, 0}}, {{0, 1}},
                          {.stiffness = omega * omega * mass * r, .damping = 2 * zeta * omega * mass * r}, mass);
    for (std::size_t i = 0; i < 3; ++i) model.fixed[i] = 1;
    update_masses(model);
    return model;
  }
};

// Largest absolute eigenvalue of the step (x, v) -> (x', v'), measured.
double measure_spectral_radius(const IntegratorRow& row, const Mode& mode, double h) {
  const Model model = mode.make_model();
  const System system(model);
  const auto integrator = row.make(system, tight());
  const double size = 0x1p-10;
  Eigen::Matrix2d step;
  for (int column = 0; column < 2; ++column) {
    State state = make_state(model.rest_positions);
    (column == 0 ? state.positions : state.velocities)[3] += size * (column == 0 ? 1.0 : mode.omega);
    StepStatistics statistics;
    integrator->invalidate();
    integrator->step(system, h, state, statistics);
    step.col(column) << (state.positions[3] - model.rest_positions[3]) / size,
        state.velocities[3] / (size * mode.omega);
  }
  return Eigen::EigenSolver<Eigen::Matrix2d>(step, false).eigenvalues().cwiseAbs().maxCoeff();
}

TEST_P(SchemeKit, AdvertisesTheStabilityLimitItHas) {
  for (const double omega : {3.0, 31.6}) {
    for (const double zeta : {0.0, 0.01, 0.1, 0.5, 0.9, 1.0, 1.5, 4.0}) {
      SCOPED_TRACE(testing::Message() << "omega=" << omega << " zeta=" << zeta);
      const Mode mode{omega, zeta};
      const double limit = row_.calc_stable_step(omega, 2.0 * zeta * omega);
      ASSERT_FALSE(std::isnan(limit));
      ASSERT_EQ(std::isinf(limit), row_.implicit);
      if (row_.implicit) {
        for (const double h : {0.1, 1.0, 30.0}) EXPECT_LE(measure_spectral_radius(row_, mode, h / omega), 1.0 + 1e-12);
      } else if (limit == 0.0) {
        for (const double h : {1e-3, 0.1, 1.0}) EXPECT_GT(measure_spectral_radius(row_, mode, h / omega), 1.0);
      } else {
        for (const double part : {0.01, 0.3, 0.9, 0.999}) {
          EXPECT_LE(measure_spectral_radius(row_, mode, part * limit), 1.0 + 1e-10) << part;
        }
        EXPECT_GT(measure_spectral_radius(row_, mode, 1.001 * limit), 1.0 + 1e-10);
      }
    }
  }
}

TEST_P(SchemeKit, LimitOfAnOverdampedDashpotIsFiniteAndPositive) {
  // No stiffness at all: v' = -c v.
  const double limit = row_.calc_stable_step(0.0, 10.0);
  EXPECT_FALSE(std::isnan(limit));
  EXPECT_GT(limit, 0.0);
  if (!row_.implicit) {
    // Roots of amplification = -1 in z = c h: 1 - z; Verlet 1 - z + z^2/2 - z^3/8; Runge-Kutta's polynomial.
    EXPECT_NEAR(limit, row_.order == 4 ? 0.2785 : row_.order == 2 ? 0.3087 : 0.2, 1e-3);
  }
  EXPECT_TRUE(std::isinf(row_.calc_stable_step(0.0, 0.0)));
}

INSTANTIATE_TEST_SUITE_P(EveryScheme, SchemeKit, testing::ValuesIn(integrators().begin(), integrators().end()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(IntegratorTable, PublishedLimitsAreMet) {
  const auto limit = [](std::string_view name, double zeta) {
    return find_integrator(name)->calc_stable_step(1.0, 2.0 * zeta);
  };
  EXPECT_NEAR(limit("symplectic_euler", 0.0), 2.0, 1e-8);
  EXPECT_NEAR(limit("symplectic_euler", 0.1), 1.809975124224, 1e-8);
  EXPECT_NEAR(limit("symplectic_euler", 1.0), 0.828427124746, 1e-8);
  EXPECT_NEAR(limit("velocity_verlet", 0.0), 2.0, 1e-8);
  EXPECT_NEAR(limit("rk4", 0.0), 2.0 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(limit("rk4", 0.1), 2.951, 1e-3);
  EXPECT_NEAR(limit("rk4", 2.0), 0.746, 1e-3);
  EXPECT_EQ(limit("forward_euler", 0.0), 0.0);
  EXPECT_NEAR(limit("forward_euler", 0.1), 0.2, 1e-8);
  EXPECT_NEAR(limit("forward_euler", 2.0), 2.0 / (2.0 + std::sqrt(3.0)), 1e-8);
  EXPECT_TRUE(std::isinf(limit("backward_euler", 0.1)));
}

TEST(IntegratorTable, UnknownNamesAreNotFound) {
  EXPECT_EQ(find_integrator("leapfrog"), nullptr);
  for (const IntegratorRow& row : integrators()) EXPECT_EQ(find_integrator(row.name)->make, row.make);
}

}  // namespace
}  // namespace flexcast::test
