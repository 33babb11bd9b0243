// B19, B20: tetrahedra in motion.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/reference/golden_tet.h"
#include "tests/reference/tables.h"
#include "tests/support/dense.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

std::unique_ptr<Simulation> make_cantilever(double step) {
  return make(concat("name = \"cantilever\"\n", time_table("symplectic_euler", step),
                     "[[body]]\nname = \"beam\"\nmodel = \"fem\"\n"
                     "mesh = { shape = \"beam\", cells = [20, 2, 2], size = [1, 0.1, 0.1] }\n"
                     "material = { law = \"corotational\", young = 1e6, poisson = 0.3, density = 1000 }\n"
                     "pin = [ { select = { box = [[0, 0, 0], [0, 0.1, 0.1]] } } ]\n"));
}

constexpr double critical_step = 9.029559286e-4;  // s

// The largest displacement over that at the start; looks at every hundredth step.
double calc_growth(double step, int steps) {
  const double size = 1e-6;  // m
  const auto rest = make_cantilever(step);
  State state = rest->state();
  SplitMix64 random(19);
  for (Eigen::Index i = 0; i < state.positions.size(); ++i) {
    const double kick = random.uniform(-size, size);
    if (!rest->model().fixed[static_cast<std::size_t>(i)]) state.positions[i] += kick;
  }
  Simulation simulation(rest->model(), rest->settings(), state, {});
  double growth = 1.0;
  for (int i = 1; i <= steps && growth <= 1e6; ++i) {
    if (!simulation.step()) return std::numeric_limits<double>::infinity();
    if (i % 100 == 0)
      growth = std::max(growth, calc_max_error(simulation.state().positions, rest->state().positions) / size);
  }
  return growth;
}

TEST(Reference, B19_LargestFrequencyOfTheCantileverMatches) {
  const auto simulation = make_cantilever(1e-4);
  const Model& model = simulation->model();
  const Eigen::MatrixXd K = calc_stiffness(model, model.rest_positions);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    if (!model.fixed[static_cast<std::size_t>(i)]) free.push_back(i);
  }
  Eigen::MatrixXd scaled = K(free, free);
  for (Eigen::Index i = 0; i < scaled.rows(); ++i) {
    const double scale = 1.0 / std::sqrt(model.masses[free[static_cast<std::size_t>(i)] / 3]);
    scaled.row(i) *= scale;
    scaled.col(i) *= scale;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  EXPECT_NEAR(std::sqrt(solver.eigenvalues().maxCoeff()), 2214.947526, 1e-9 * 2214.947526);
}

TEST(Reference, B19_AdvertisedStepOfTheCantileverIsSafeAndUseful) {
  const double advertised = make_cantilever(1e-4)->calc_stable_step();
  EXPECT_LE(advertised, critical_step);
  EXPECT_GE(advertised, 0.3 * critical_step);
}

TEST(Reference, B19_CantileverIsBoundedForAHundredThousandStepsJustBelowTheLimit) {
  EXPECT_LT(calc_growth(0.99 * critical_step, 100000), 1e3);
}

TEST(Reference, B19_CantileverDivergesJustAboveTheLimit) {
  EXPECT_GT(calc_growth(1.01 * critical_step, 100000), 1e6);
}

TEST(Reference, B20_GoldenTetrahedronMovesAsPublishedUnderEachScheme) {
  const Json table = load_reference("tet_dynamics.json");
  const VecX start = to_flat(tet_vectors()["states"]["moderate"]["x"]);
  const VecX kick = to_flat(table["v0"]);
  for (const char* law : {"linear", "corotational"}) {
    const Json& rows = table[std::string(law) == "linear" ? "linear" : "corot"];
    for (const auto& [integrator, key] : {std::pair{"symplectic_euler", "symplectic_euler"},
                                          {"velocity_verlet", "velocity_verlet"},
                                          {"backward_euler", "backward_euler"},
                                          {"rk4", "exact_t=0.01"}}) {
      SCOPED_TRACE(concat(law, " ", integrator));
      Simulation simulation(make_golden_tet(law), make_settings(integrator, 1e-4), make_state(start, kick), {});
      EXPECT_NEAR(simulation.model().masses[0], table["m_node"], 1e-12);
      run(simulation, 100);
      EXPECT_LE(calc_max_error(simulation.state().positions, to_flat(rows[key]["x"])), 1e-10);
      EXPECT_LE(calc_max_error(simulation.state().velocities, to_flat(rows[key]["v"])), 1e-8);
    }
  }
}

}  // namespace
}  // namespace flexcast::test
