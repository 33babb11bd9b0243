// element = "tet10", and surface forces on both elements.
#include <set>

#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

// The beam of 2 x 1 x 1 cells of 1 m: nodes 0 to 11 are the corners.
Scene with_beam_lines(const std::string& lines) {
  return loaded(changed("model = \"fem\"\n", "model = \"fem\"\n" + lines));
}
std::string beam_refusal(const std::string& lines) {
  return refusal(changed("model = \"fem\"\n", "model = \"fem\"\n" + lines));
}

const Body& beam(const Scene& scene) {
  return scene.simulation->model().bodies[0];
}

Vec3 rest(const Scene& scene, std::int32_t particle) {
  return block3(scene.simulation->model().rest_positions, particle);
}

Vec3 force(const Scene& scene, std::int32_t particle) {
  return block3(scene.simulation->model().external_forces, particle);
}

const std::string tet10 = "element = \"tet10\"\n";

TEST(Quadratic, BodyHasAMidsideNodeAmidEveryEdge) {
  const Scene scene = with_beam_lines(tet10 + "origin = [1.0, 2.0, 3.0]\n");
  const Model& model = scene.simulation->model();
  ASSERT_TRUE(beam(scene).is_quadratic());
  EXPECT_EQ(beam(scene).tetrahedra.count, 12);
  EXPECT_EQ(beam(scene).midsides.count, 12);
  EXPECT_EQ(model.bodies[1].particles.first, beam(scene).particles.count);
  EXPECT_FALSE(model.bodies[1].is_quadratic());
  for (std::size_t t = 0; t < 12; ++t) {
    EXPECT_GE(model.midsides[t][0], 12);
    EXPECT_EQ(rest(scene, model.midsides[t][0]),
              0.5 * (rest(scene, model.tetrahedra[t][0]) + rest(scene, model.tetrahedra[t][1])));
  }
  EXPECT_NEAR(model.masses.head(beam(scene).particles.count).sum(), 2000.0, 1e-9);
}

TEST(Quadratic, BehindAnotherBodyRefersToItsOwnNodes) {
  std::string text = changed("name = \"beam\"", "name = \"other\"");
  text = changed("[[probe]]\nname = \"tip\"\nbody = \"beam\"",
                 "[[body]]\nname = \"beam\"\nmodel = \"fem\"\nelement = \"tet10\"\nmesh = { shape = \"beam\", cells = "
                 "[1, 1, 1], size = [1.0, 1.0, 1.0] }\nmaterial = { law = \"linear\", young = 1e6, poisson = 0.4, "
                 "density = 1.0 }\norigin = [5.0, 0.0, 0.0]\n[[probe]]\nname = \"tip\"\nbody = \"beam\"",
                 text);
  const Scene scene = loaded(text);
  const Model& model = scene.simulation->model();
  const Body& last = model.bodies[2];
  EXPECT_EQ(last.midsides.first, 0);
  EXPECT_EQ(last.midsides.count, 6);
  for (const Midsides& midsides : model.midsides)
    for (const std::int32_t node : midsides) {
      EXPECT_GE(node, last.particles.first + 8);
      EXPECT_LT(node, last.particles.end());
    }
}

TEST(Quadratic, ListedNodesBringTheMidsideNodesBetweenThem) {
  const Scene scene = with_beam_lines(tet10 + "pin = [ { select = { nodes = [0, 3, 6, 9] } } ]\n");
  const auto& fixed = scene.simulation->model().fixed;
  int pinned = 0;
  for (std::int32_t i = 0; i < beam(scene).particles.count; ++i) {
    const bool is_fixed = fixed[3 * static_cast<std::size_t>(i)] != 0;
    EXPECT_EQ(is_fixed, rest(scene, i).x() == 0.0) << i;
    pinned += is_fixed;
  }
  EXPECT_EQ(pinned, 9);
}

TEST(Quadratic, ASingleListedNodeIsThatNode) {
  const Scene scene = with_beam_lines(tet10 + "force = [ { select = { nodes = [0, 11] }, value = [0, 0, 1] } ]\n");
  double total = 0.0;
  for (std::int32_t i = 0; i < beam(scene).particles.count; ++i) total += force(scene, i).z();
  EXPECT_EQ(total, 2.0);
}

TEST(Quadratic, ProbesMayWatchMidsideNodes) {
  const Scene scene = loaded(changed("at = [2.0, 0.0, 0.0]", "at = [1.5, 0.0, 0.0]",
                                     changed("model = \"fem\"\n", "model = \"fem\"\n" + tet10)));
  EXPECT_EQ(rest(scene, scene.simulation->probes()[0].particle), Vec3(1.5, 0, 0));
}

const std::string end_force =
    "surface_force = [ { select = { box = [[2, 0, 0], [2, 1, 1]] }, value = [6.0, 0.0, -12.0] } ]\n";

TEST(SurfaceForce, IsSpreadOverTheFacesWhoseVerticesAreSelected) {
  for (const std::string& element : {std::string(), tet10}) {
    const Scene scene = with_beam_lines(element + end_force);
    Vec3 total = Vec3::Zero(), torque = Vec3::Zero();
    for (std::int32_t i = 0; i < beam(scene).particles.count; ++i) {
      total += force(scene, i);
      torque += rest(scene, i).cross(force(scene, i));
      if (rest(scene, i).x() < 2.0) {
        EXPECT_EQ(force(scene, i), Vec3(0, 0, 0)) << i;
      }
    }
    EXPECT_LT((total - Vec3(6, 0, -12)).norm(), 1e-14);
    EXPECT_LT((torque - Vec3(2.0, 0.5, 0.5).cross(Vec3(6, 0, -12))).norm(), 1e-13);
  }
}

TEST(SurfaceForce, AddsUpWithForces) {
  const Scene scene = with_beam_lines(end_force + "force = [ { select = { nodes = [0] }, value = [0, 7, 0] } ]\n" +
                                      "particle_mass = [ { select = { nodes = [0] }, value = 1.0 } ]\n");
  EXPECT_EQ(force(scene, 0), Vec3(0, 7, 0));
  EXPECT_GT(force(scene, 2).x(), 0.0);
  EXPECT_EQ(force(scene, 12), Vec3(0, 0, 0));
}

TEST(SurfaceForce, WorksOnABodyThatIsNotTheFirst) {
  const std::string lines =
      "[[body]]\nname = \"late\"\nmodel = \"fem\"\nelement = \"tet10\"\nmesh = { shape = \"beam\", cells = [1, 1, 1], "
      "size = [1.0, 1.0, 1.0] }\nmaterial = { law = \"linear\", young = 1e6, poisson = 0.4, density = 1.0 }\n"
      "surface_force = [ { select = { box = [[0, 0, 1], [1, 1, 1]] }, value = [0.0, 0.0, 3.0] } ]\n";
  const Scene scene = loaded(with_spring_lines(lines));
  const Body& late = scene.simulation->model().bodies[2];
  double total = 0.0;
  for (std::int32_t i = 0; i < late.particles.end(); ++i) {
    const bool on_top = i >= late.particles.first && rest(scene, i).z() == 1.0;
    if (!on_top) {
      EXPECT_EQ(force(scene, i), Vec3(0, 0, 0)) << i;
    }
    total += force(scene, i).z();
  }
  EXPECT_NEAR(total, 3.0, 1e-14);
}

TEST(SurfaceForce, NeedsAWholeFace) {
  const std::string message =
      "test.toml:8: [[body]] \"beam\": surface_force[0].select selects no whole face of the body's surface, which the "
      "force needs";
  for (const std::string nodes : {"[0]", "[0, 1]", "[0, 11]", "[0, 1, 11]"}) {
    EXPECT_EQ(beam_refusal("surface_force = [ { select = { nodes = " + nodes + " }, value = [0, 0, 1] } ]\n"), message);
  }
}

TEST(SurfaceForce, RefusesWhatItsKeysDoNotAllow) {
  const std::string where = "test.toml:8: [[body]] \"beam\": ";
  EXPECT_EQ(beam_refusal("surface_force = [ { select = { all = true } } ]\n"),
            where + "missing key surface_force[0].value; expected an array of 3 numbers (any finite number, N)");
  EXPECT_EQ(beam_refusal("surface_force = [ { value = [0, 0, 1] } ]\n"),
            where + "missing key surface_force[0].select; expected a table");
  EXPECT_EQ(beam_refusal("surface_force = [ { select = { all = true }, value = [0, inf, 1] } ]\n"),
            where + "surface_force[0].value[1] = inf is out of range (allowed: any finite number, N)");
  EXPECT_EQ(beam_refusal("surface_force = [ { select = { all = true }, pressure = 1.0 } ]\n"),
            where + "unknown key surface_force[0].pressure = 1.0 (allowed: select, value)");
  EXPECT_EQ(beam_refusal("surface_force = 3\n"),
            where + "surface_force = 3 is an integer; expected an array of tables");
  EXPECT_EQ(refusal(with_spring_lines("surface_force = []")),
            "test.toml:16: [[body]] \"cloth\": surface_force = [] belongs to model = \"fem\", not to this body's");
}

}  // namespace
}  // namespace flexcast::test
