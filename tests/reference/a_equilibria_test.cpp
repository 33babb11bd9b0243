// A11, A12: chains and cables at rest.
#include <gtest/gtest.h>

#include <numbers>

#include "core/forces/spring.h"
#include "tests/reference/statics.h"

namespace flexcast::test {
namespace {

// Ten masses of 0.1 kg on springs with k_s = 50 N, r = 0.1 m, hanging along -y from a fixed one.
std::string hanging_chain(std::string_view integrator, double step, const std::string& more = "") {
  return concat("name = \"chain\"\ngravity = [0, -9.81, 0]\n[time]\nstep = ", step, "\nintegrator = \"", integrator,
                "\"\n[solver]\nlinear = \"ldlt\"\nnewton_tolerance = 1e-12\n"
                "[[body]]\nname = \"chain\"\nmodel = \"mass_spring\"\n"
                "mesh = { shape = \"rope\", cells = [10], size = [1] }\nsprings = { stiffness = 50, damping = 0.05 }\n"
                "mass = 0.1\nrotation = [0, 0, ",
                -0.5 * std::numbers::pi, "]\npin = [ { select = { nodes = [0] } } ]\n", more);
}

void expect_hanging(const Simulation& simulation, double tolerance) {
  EXPECT_NEAR(0.1 * 0.1 * 9.81 * 10 * 11 / (2 * 50.0), 0.10791, 1e-15);
  EXPECT_NEAR(position(simulation, 10).y(), -1.10791, tolerance);
  for (int j = 1; j <= 10; ++j) {
    const double length = (position(simulation, j) - position(simulation, j - 1)).norm();
    EXPECT_NEAR(length - 0.1, 0.1 * 0.1 * 9.81 * (10 - j + 1) / 50.0, tolerance) << "spring " << j;
    EXPECT_NEAR(position(simulation, j).x(), 0.0, tolerance);
  }
}

TEST(Reference, A11_HangingChainAtRestHasTheExactElongations) {
  const auto simulation = make(hanging_chain("quasi_static", 1.0));
  EXPECT_TRUE(solve_static(*simulation));
  expect_hanging(*simulation, 1e-10);
}

TEST(Reference, A11_HangingChainRelaxesDynamicallyToTheSameElongations) {
  const auto swaying = make(hanging_chain("symplectic_euler", 1e-3, "damping = { mass = 3 }\n"));
  run(*swaying, 20000);
  expect_hanging(*swaying, 1e-6);
  const auto creeping = make(hanging_chain("backward_euler", 0.1, "damping = { mass = 3 }\n"));
  run(*creeping, 300);
  expect_hanging(*creeping, 1e-6);
}

// Twenty springs with r = 0.1 m, k_s = 200 N and masses of 0.05 kg between (0, 0) and (1.5, 0).
std::unique_ptr<Simulation> make_cable() {
  return make(
      "name = \"cable\"\ngravity = [0, -9.81, 0]\n[time]\nstep = 1\nintegrator = \"quasi_static\"\n"
      "[solver]\nnewton_tolerance = 1e-12\n[[body]]\nname = \"cable\"\nmodel = \"mass_spring\"\n"
      "mesh = { shape = \"rope\", cells = [20], size = [2] }\nsprings = { stiffness = 200, damping = 0 }\n"
      "mass = 0.05\npin = [ { select = { nodes = [0, 20] } } ]\n"
      "displacement = [ { select = { nodes = [20] }, value = [-0.5, 0, 0] } ]\n");
}

TEST(Reference, A12_CableHangsInTheDiscreteCatenary) {
  const auto simulation = make_cable();
  EXPECT_TRUE(solve_static(*simulation));
  EXPECT_NEAR(position(*simulation, 10).y(), -0.6155596865925523, 1e-8);
  EXPECT_NEAR(position(*simulation, 10).x(), 0.75, 1e-8);
  EXPECT_NEAR(position(*simulation, 5).x(), 0.29785990543093, 1e-8);
  EXPECT_NEAR(position(*simulation, 5).y(), -0.41295605707888, 1e-8);
  for (int j = 1; j <= 20; ++j) {
    const Vec3 d = position(*simulation, j) - position(*simulation, j - 1);
    EXPECT_NEAR(calc_spring_force(d, Vec3::Zero(), 0.1, 200.0, 0.0).x(), 2.592111779653251, 1e-8) << "spring " << j;
    EXPECT_EQ(position(*simulation, j).z(), 0.0);
  }
  // Irvine, Cable Structures (MIT Press, 1981): the continuous cable sags 0.14 % less.
  EXPECT_NEAR(-position(*simulation, 10).y() / 0.61469745656, 1.0014, 1e-4);
}

}  // namespace
}  // namespace flexcast::test
