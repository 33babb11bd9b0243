// B02, B08: equilibria that linear tetrahedra represent exactly.
#include <gtest/gtest.h>

#include "core/mesh/topology.h"
#include "tests/reference/tables.h"
#include "tests/support/model.h"
#include "tests/support/reference.h"

namespace flexcast::test {
namespace {

// A bar of one element's thickness on rollers.
std::string bar_on_rollers(std::string_view law) {
  return concat("name = \"bar\"\n", time_table("backward_euler", 1e4),
                "[[body]]\nname = \"bar\"\nmodel = \"fem\"\n"
                "mesh = { shape = \"beam\", cells = [3, 1, 1], size = [3, 1, 1] }\nmaterial = { law = \"",
                law,
                "\", young = 1.3e5, poisson = 0.3, density = 1000 }\n"
                "pin = [ { select = { box = [[0, 0, 0], [0, 1, 1]] }, axes = \"x\" },\n"
                "        { select = { box = [[0, 0, 0], [3, 0, 1]] }, axes = \"y\" },\n"
                "        { select = { box = [[0, 0, 0], [3, 1, 0]] }, axes = \"z\" } ]\n");
}

// Pulled at its end by a uniform dead traction (Pa): every triangle gives a third to each of its corners. Huge implicit
// steps settle in the equilibrium.
std::unique_ptr<Simulation> make_pulled_bar(std::string_view law, double traction) {
  const auto free = make(bar_on_rollers(law));
  Model model = free->model();
  model.external_forces = VecX::Zero(model.rest_positions.size());
  for (const Triangle& triangle : make_boundary_triangles(model.tetrahedra)) {
    const auto x = [&](std::size_t corner) { return model.rest_positions[3 * triangle[corner]]; };
    if (x(0) != 3.0 || x(1) != 3.0 || x(2) != 3.0) continue;
    for (const std::int32_t node : triangle) model.external_forces[3 * node] += 0.5 * traction / 3.0;
  }
  auto simulation = std::make_unique<Simulation>(model, free->settings(), free->state(), std::vector<Probe>{});
  run(*simulation, 10);
  return simulation;
}

TEST(Reference, B02_BarOnRollersTakesTheUniaxialStretches) {
  const Json table = load_reference("materials.json")["uniaxial_stress"];
  for (const ReferenceLaw& law : reference_laws()) {
    for (const auto& [name, stretch] : {std::pair{"0.9", 0.9}, {"1.1", 1.1}, {"2", 2.0}}) {
      SCOPED_TRACE(concat(law.law, " stretch ", stretch));
      const Json& expected = table[name][std::string(law.key)];
      const auto simulation = make_pulled_bar(law.law, expected["P11"]);
      const double lateral = expected["lateral_stretch"];
      const VecX& rest = simulation->model().rest_positions;
      for (std::int64_t i = 0; i < simulation->model().particle_count(); ++i) {
        const Vec3 exact = Vec3(stretch, lateral, lateral).cwiseProduct(block3(rest, i));
        EXPECT_LE(calc_max_error(position(*simulation, i), exact), 1e-9) << "particle " << i;
      }
    }
  }
}

// u = size (2x + y + z, x + 2y + z, x + y + 2z) / 2: all normal strains and engineering shears are `size`.
Vec3 calc_patch_displacement(const Vec3& X, double size) {
  return 0.5 * size * (X + Vec3::Constant(X.sum()));
}

// The published patch with its corners displaced; the nodes inside are free.
std::unique_ptr<Simulation> make_patch(const Json& patch, std::string_view law, double size) {
  Points nodes;
  for (const Json& node : patch["nodes"]) nodes.push_back(to_vector(node));
  std::vector<Tetrahedron> tetrahedra = patch["tets(Delaunay)"].get<std::vector<Tetrahedron>>();
  for (Tetrahedron& tetrahedron : tetrahedra) {
    if (calc_six_volumes(nodes, tetrahedron) < 0.0) std::swap(tetrahedron[2], tetrahedron[3]);
  }
  Model model = make_tet_model(nodes, tetrahedra, {.law = law, .young = 1e6, .poisson = 0.25});
  VecX start = model.rest_positions;
  for (std::int64_t i = 0; i < 8; ++i) {
    block3(start, i) += calc_patch_displacement(nodes[static_cast<std::size_t>(i)], size);
    for (std::size_t axis = 0; axis < 3; ++axis) model.fixed[static_cast<std::size_t>(3 * i) + axis] = 1;
  }
  auto simulation = std::make_unique<Simulation>(model, make_settings("backward_euler", 1e3), make_state(start),
                                                 std::vector<Probe>{});
  run(*simulation, 6);
  return simulation;
}

Mat3 calc_patch_stress(const Simulation& simulation, const Tetrahedron& tetrahedron) {
  Mat3 Dm, Ds;
  for (int a = 0; a < 3; ++a) {
    const auto edge = [&](const VecX& x) { return Vec3(block3(x, tetrahedron[a + 1]) - block3(x, tetrahedron[0])); };
    Dm.col(a) = edge(simulation.model().rest_positions);
    Ds.col(a) = edge(simulation.state().positions);
  }
  const Mat3 F = Ds * Dm.inverse();
  Mat3 P;
  simulation.model().bodies[0].law->calc_stress(calc_lame(1e6, 0.25), {&F, 1}, {&P, 1});
  return P;
}

TEST(Reference, B08_LinearLawPassesThePatchTest) {
  const Json patch = load_reference("patch.json");
  const auto simulation = make_patch(patch, "linear", 1e-3);
  const VecX& rest = simulation->model().rest_positions;
  for (std::int64_t i = 8; i < 16; ++i) {
    const Vec3 u = position(*simulation, i) - block3(rest, i);
    EXPECT_LE(calc_max_error(u, calc_patch_displacement(block3(rest, i), 1e-3)), 1e-12) << "node " << i;
    EXPECT_LE(calc_max_error(u, to_vector(patch["u_interior"][static_cast<std::size_t>(i - 8)])), 1e-12);
  }
  Mat3 stress = Mat3::Constant(400.0);
  stress.diagonal().setConstant(2000.0);
  for (const Tetrahedron& tetrahedron : simulation->model().tetrahedra) {
    EXPECT_LE(calc_max_error(calc_patch_stress(*simulation, tetrahedron), stress), 1e-9 * 2000.0);
  }
  EXPECT_NEAR(simulation->calc_report().elastic, 3.6, 1e-9 * 3.6);
}

TEST(Reference, B08_NonlinearLawsPassThePatchTestAtSmallStrain) {
  const Json patch = load_reference("patch.json");
  for (const ReferenceLaw& law : reference_laws()) {
    if (law.law == "linear") continue;
    SCOPED_TRACE(law.law);
    const auto simulation = make_patch(patch, law.law, 1e-6);
    const VecX& rest = simulation->model().rest_positions;
    for (std::int64_t i = 8; i < 16; ++i) {
      const Vec3 u = position(*simulation, i) - block3(rest, i);
      EXPECT_LE(calc_max_error(u, calc_patch_displacement(block3(rest, i), 1e-6)), 1e-5 * 1e-6) << "node " << i;
    }
    Mat3 stress = Mat3::Constant(0.4);
    stress.diagonal().setConstant(2.0);
    for (const Tetrahedron& tetrahedron : simulation->model().tetrahedra) {
      EXPECT_LE(calc_max_error(calc_patch_stress(*simulation, tetrahedron), stress), 1e-5 * 2.0);
    }
    EXPECT_NEAR(simulation->calc_report().elastic, 3.6e-6, 1e-5 * 3.6e-6);
  }
}

}  // namespace
}  // namespace flexcast::test
