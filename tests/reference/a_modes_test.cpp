// A13: normal modes of a chain of five masses of 0.1 kg, k = 1000 N/m.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "tests/support/model.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

struct Chain {
  const char* name;
  int springs;
  std::vector<int> pinned;
  std::vector<double> frequencies;  // rad/s, published
};

const std::vector<Chain>& chains() {
  static const std::vector<Chain> list = {
      {"fixed-fixed", 6, {0, 6}, {51.7638090205, 100, 141.4213562373, 173.2050807569, 193.1851652578}},
      {"fixed-free", 5, {0}, {28.4629676547, 83.0830026004, 130.972146789, 168.250706566, 191.898594723}},
      {"free-free", 4, {}, {0, 61.803398875, 117.557050458, 161.803398875, 190.211303259}}};
  return list;
}

// The same to all digits: 2 sqrt(k/m) sin of these angles.
double calc_frequency(const Chain& chain, int p) {
  const double pi = std::numbers::pi;
  const double angle = chain.springs == 6   ? (p + 1) * pi / 12
                       : chain.springs == 5 ? (2 * p + 1) * pi / 22
                                            : p * pi / 10;
  return 200.0 * std::sin(angle);
}

std::unique_ptr<Simulation> make_chain(const Chain& chain, std::string_view integrator, double step) {
  std::string pins;
  for (const int node : chain.pinned) pins += concat("{ select = { nodes = [", node, "] } }, ");
  return make(concat("name = \"chain\"\n", time_table(integrator, step),
                     "[[body]]\nname = \"chain\"\nmodel = \"mass_spring\"\nmesh = { shape = \"rope\", cells = [",
                     chain.springs, "], size = [", 0.1 * chain.springs,
                     "] }\nsprings = { stiffness = 100, damping = 0 }\nmass = 0.1\n",
                     pins.empty() ? "" : "pin = [ " + pins + "]\n"));
}

// Along the chain springs are linear, so differences of forces are exact whatever the displacement.
Eigen::MatrixXd calc_axial_stiffness(const Simulation& simulation) {
  const Model& model = simulation.model();
  std::vector<std::int64_t> moving;
  for (std::int64_t i = 0; i < model.particle_count(); ++i) {
    if (!model.fixed[static_cast<std::size_t>(3 * i)]) moving.push_back(i);
  }
  const auto count = static_cast<Eigen::Index>(moving.size());
  Eigen::MatrixXd stiffness(count, count);
  const double reach = 0.03125;  // m
  for (Eigen::Index j = 0; j < count; ++j) {
    VecX plus = model.rest_positions, minus = model.rest_positions;
    plus[3 * moving[static_cast<std::size_t>(j)]] += reach;
    minus[3 * moving[static_cast<std::size_t>(j)]] -= reach;
    const VecX change = (measure_forces(model, minus) - measure_forces(model, plus)) / (2.0 * reach);
    for (Eigen::Index i = 0; i < count; ++i) stiffness(i, j) = change[3 * moving[static_cast<std::size_t>(i)]];
  }
  return stiffness;
}

TEST(Reference, A13_ChainFrequenciesMatchTheClosedForm) {
  for (const Chain& chain : chains()) {
    SCOPED_TRACE(chain.name);
    const auto simulation = make_chain(chain, "symplectic_euler", 1e-3);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(calc_axial_stiffness(*simulation) / 0.1);
    ASSERT_EQ(solver.eigenvalues().size(), 5);
    for (int p = 0; p < 5; ++p) {
      const double exact = calc_frequency(chain, p);
      const double published = chain.frequencies[static_cast<std::size_t>(p)];
      EXPECT_NEAR(exact, published, 1e-9);
      if (exact == 0.0) {
        EXPECT_NEAR(solver.eigenvalues()[p], 0.0, 1e-12 * 4e4);
      } else {
        EXPECT_NEAR(std::sqrt(solver.eigenvalues()[p]), exact, 1e-12 * exact);
      }
    }
  }
}

TEST(Reference, A13_MeasuredFrequenciesMatchTheModes) {
  const Chain& chain = chains()[0];
  const double step = 1e-4;
  for (int p = 1; p <= 5; ++p) {
    auto start = make_chain(chain, "velocity_verlet", step);
    State state = start->state();
    for (int j = 1; j <= 5; ++j) state.positions[3 * j] += 0.01 * std::sin(p * j * std::numbers::pi / 6.0);
    Simulation simulation(start->model(), start->settings(), state, {});
    const double rest = start->state().positions[3];
    double before = position(simulation, 1).x() - rest, first = 0.0, last = 0.0;
    int crossings = 0;
    while (crossings < 41) {
      run(simulation, 1);
      const double now = position(simulation, 1).x() - rest;
      if ((now < 0.0) != (before < 0.0)) {
        last = simulation.state().time - step * now / (now - before);
        if (crossings++ == 0) first = last;
      }
      before = now;
    }
    const double measured = 40.0 * std::numbers::pi / (last - first);
    EXPECT_NEAR(measured / calc_frequency(chain, p - 1), 1.0, 1e-4) << "mode " << p;
  }
}

TEST(Reference, A13_AdvertisedStepOfTheChainIsSafeAndUseful) {
  const double critical = 0.0103527618041008;
  const double advertised = make_chain(chains()[0], "symplectic_euler", 1e-3)->calc_stable_step();
  EXPECT_LE(advertised, critical);
  EXPECT_GE(advertised, 0.3 * critical);
}

}  // namespace
}  // namespace flexcast::test
