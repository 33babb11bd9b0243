// The observed order of convergence of every scheme that has one, on smooth nonlinear scenes, against a solution that
// no longer changes.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/integrators/integrator.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

constexpr double end = 0.125;  // s

struct Case {
  const char* name;
  bool springs;
  std::string_view law;
  bool quadratic, damped, handled;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> list = {{"springs", true, "", false, false, false},
                                         {"damped_springs", true, "", false, true, false},
                                         {"springs_on_a_handle", true, "", false, false, true},
                                         {"damped_springs_on_a_handle", true, "", false, true, true},
                                         {"corotational", false, "corotational", false, false, false},
                                         {"damped_corotational", false, "corotational", false, true, false},
                                         {"damped_corotational_on_a_handle", false, "corotational", false, true, true},
                                         {"neo_hookean", false, "neo_hookean", false, false, false},
                                         {"damped_neo_hookean", false, "neo_hookean", false, true, false},
                                         {"neo_hookean_on_a_handle", false, "neo_hookean", false, false, true},
                                         {"quadratic_neo_hookean", false, "neo_hookean", true, true, true}};
  return list;
}

Model make_case_model(const Case& scene) {
  Model model;
  if (scene.springs) {
    const Mesh mesh = make_lattice({2, 1, 1}, {1.0, 0.5, 0.5});
    model = make_spring_model(mesh.nodes, mesh.springs, {.stiffness = 20.0}, 0.1);
  } else {
    const Mesh mesh = make_beam({scene.quadratic ? 1 : 2, 1, 1}, {1.0, 0.5, 0.5});
    const Elastic elastic = {.law = scene.law, .young = 1e4, .poisson = 0.3, .density = 1000.0};
    model = scene.quadratic ? make_quadratic_model(mesh, elastic) : make_beam_model(mesh, elastic);
  }
  model.gravity = {0.0, 0.5, -9.81};
  Body& body = model.bodies[0];
  if (scene.damped) {
    body.damping = 0.3;
    body.stiffness_damping = 5e-3;
    body.mass_damping = 0.5;
    body.drag = 0.2;
  }
  if (scene.handled) {
    Handle handle;
    handle.particles = {0, 3};
    handle.translate = {0.3, -0.2, 0.6};
    handle.rotate = {0.9, 0.5, -0.4};
    for (const std::int32_t i : handle.particles) handle.base.emplace_back(block3(model.rest_positions, i));
    handle.about = {0.1, 0.0, 0.2};
    handle.start = -0.5;  // in the middle of its motion
    handle.duration = 2.0;
    model.handles.push_back(handle);
  }
  update_masses(model);
  return model;
}

// Bent, twisted and thrown.
State make_start(const Model& model) {
  State state = make_state(model.rest_positions, VecX::Zero(model.rest_positions.size()));
  for (std::int64_t i = 0; i < model.particle_count(); ++i) {
    const Vec3 X = block3(model.rest_positions, i);
    block3(state.positions, i) += Vec3(0.05 * X.y(), 0.1 * X.x() * X.x(), 0.1 * X.x() * X.y());
    block3(state.velocities, i) = Vec3(0.5, 0.3 * X.x(), 1.0 * X.x() * X.x()) + Vec3(1, 2, 1).cross(X);
  }
  return state;
}

// Positions and velocities (as lengths over a tenth of a second) at the end.
VecX calc_end(const Model& model, std::string_view integrator_name, int steps) {
  const System system(model);
  const auto integrator = find_integrator(integrator_name)->make(system, make_settings("", 1.0).solver);
  State state = make_start(model);
  system.prescribe(0.0, state.positions, state.velocities);
  StepStatistics statistics;
  for (int i = 0; i < steps; ++i) {
    integrator->step(system, end / steps, state, statistics);
    state.time = end * (i + 1) / steps;
  }
  VecX result(2 * state.positions.size());
  result << state.positions, 0.1 * state.velocities;
  return result;
}

class Order : public testing::TestWithParam<Case> {};

TEST_P(Order, OfEverySchemeIsItsOwnWithinATenth) {
  const Model model = make_case_model(GetParam());
  const VecX exact = calc_end(model, "rk4", 2048);
  ASSERT_LE((calc_end(model, "rk4", 1024) - exact).norm(), 1e-11 * exact.norm());
  for (const IntegratorRow& row : integrators()) {
    if (row.order == 0) continue;
    const int coarse = row.order == 1 ? 512 : row.order == 2 ? 128 : 64;
    std::vector<double> errors;
    for (const int steps : {coarse, 2 * coarse, 4 * coarse}) {
      errors.push_back((calc_end(model, row.name, steps) - exact).norm());
    }
    for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
      EXPECT_NEAR(std::log2(errors[i] / errors[i + 1]), row.order, 0.1)
          << row.name << ", " << (coarse << i) << " steps, error " << errors[i] << " then " << errors[i + 1];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SmoothScenes, Order, testing::ValuesIn(cases()),
                         [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace flexcast::test
