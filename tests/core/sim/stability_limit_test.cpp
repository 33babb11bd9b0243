// The predicted largest step of random meshes against the true one: within 5 %, and never above.
#include <gtest/gtest.h>

#include "core/integrators/integrator.h"
#include "tests/support/amplification.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

constexpr int mesh_count = 60;

Points make_jittered(Points nodes, SplitMix64& random) {
  for (Vec3& node : nodes) node += make_random_vector(random, 0.08);
  return nodes;
}

// A jittered network of springs or body of tetrahedra with unequal masses, some particles held.
Model make_random_model(int number, SplitMix64& random) {
  const auto count = [&](int most) { return 1 + static_cast<int>(random.next() % static_cast<std::uint64_t>(most)); };
  Model model;
  if (number % 2 == 0) {
    const Mesh mesh =
        number % 4 == 0 ? make_lattice({count(3), 1, 1}, {1.0, 0.8, 0.7}) : make_grid({2, count(3)}, {1.0, 1.0});
    model = make_spring_model(make_jittered(mesh.nodes, random), mesh.springs, {.stiffness = random.uniform(10, 200)},
                              random.uniform(0.05, 0.2));
  } else {
    const Mesh mesh = make_beam({count(3), 1, 1}, {1.0, 0.6, 0.7});
    const char* laws[] = {"linear", "corotational", "st_venant_kirchhoff", "neo_hookean"};
    model = make_tet_model(make_jittered(mesh.nodes, random), mesh.tetrahedra,
                           {.law = laws[number / 2 % 4], .young = 2e4, .poisson = random.uniform(0.0, 0.45)});
  }
  update_masses(model);
  for (std::int32_t i = 0; i < model.particle_count(); ++i) {
    if (number % 3 != 0)
      model.bodies[0].mass_overrides.push_back({i, model.masses[i] * std::exp(random.uniform(-1, 1))});
    if (number % 5 > 1 && i < 2) {
      for (int axis = 0; axis < 3; ++axis) model.fixed[static_cast<std::size_t>(3 * i + axis)] = 1;
    }
  }
  update_masses(model);
  return model;
}

enum Damping { none, of_mass, of_stiffness, of_drag, of_mass_and_stiffness, of_everything };
constexpr const char* damping_names[] = {"none", "mass", "stiffness", "drag", "mass and stiffness", "everything"};

// Each part of the damping alone would give the fastest mode, omega, a damping ratio of about `zeta`.
void add_damping(Model& model, Damping kind, double zeta, double omega) {
  Body& body = model.bodies[0];
  if (kind == of_mass || kind == of_mass_and_stiffness || kind == of_everything) body.mass_damping = 2 * zeta * omega;
  if (kind == of_drag || kind == of_everything) body.drag = 2 * zeta * omega * model.masses.mean();
  if (kind == of_stiffness || kind == of_mass_and_stiffness || kind == of_everything) {
    body.stiffness_damping = 2 * zeta / omega;
    body.damping = body.stiffness * 2 * zeta / omega;
  }
}

class StabilityLimit : public testing::TestWithParam<int> {};

TEST_P(StabilityLimit, IsPredictedWithinFivePercentFromBelow) {
  SplitMix64 random(1000 + static_cast<std::uint64_t>(GetParam()));
  const Model undamped = make_random_model(GetParam(), random);
  const double omega = std::sqrt(linearise(undamped).K.eigenvalues().real().maxCoeff());
  for (const Damping kind : {none, static_cast<Damping>(1 + GetParam() % 5)}) {
    Model model = undamped;
    const double zeta = std::exp(random.uniform(std::log(0.02), std::log(2.0)));
    add_damping(model, kind, zeta, omega);
    const Linearised scene = linearise(model);
    for (const IntegratorRow& row : integrators()) {
      if (row.implicit || (kind == none && row.name == "forward_euler")) continue;
      SCOPED_TRACE(testing::Message() << row.name << ", damping: " << damping_names[kind] << ", zeta " << zeta);
      const Simulation simulation(model, make_settings(std::string(row.name), 1e-3), make_state(model.rest_positions),
                                  {});
      const double predicted = simulation.calc_stable_step();
      EXPECT_TRUE(is_stable(row.name, scene, predicted));
      EXPECT_FALSE(is_stable(row.name, scene, predicted / 0.95));
    }
  }
}

// Too large for all eigenvalues: forward Euler's limit, which hangs on the least damping, is only a safe one there.
TEST(StabilityLimitOfALargerBody, IsNeverAboveTheTrueOne) {
  SplitMix64 random(77);
  const Mesh mesh = make_lattice({4, 2, 2}, {2.0, 0.8, 0.8});
  Model model = make_spring_model(make_jittered(mesh.nodes, random), mesh.springs, {.stiffness = 50.0}, 0.1);
  for (std::int32_t i = 0; i < model.particle_count(); ++i) {
    model.bodies[0].mass_overrides.push_back({i, 0.1 * std::exp(random.uniform(-1, 1))});
  }
  update_masses(model);
  add_damping(model, of_drag, 0.2,
              std::sqrt(linearise(model).K.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff()));
  const Linearised scene = linearise(model);
  ASSERT_GT(scene.K.rows(), 120);
  for (const IntegratorRow& row : integrators()) {
    if (row.implicit) continue;
    const double predicted =
        Simulation(model, make_settings(std::string(row.name), 1e-3), make_state(model.rest_positions), {})
            .calc_stable_step();
    EXPECT_TRUE(is_stable(row.name, scene, predicted)) << row.name;
    if (row.name == "forward_euler") continue;
    EXPECT_FALSE(is_stable(row.name, scene, predicted / 0.95)) << row.name;
  }
}

INSTANTIATE_TEST_SUITE_P(RandomMeshes, StabilityLimit, testing::Range(0, mesh_count));

}  // namespace
}  // namespace flexcast::test
