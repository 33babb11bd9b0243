// What a scene file says is what the simulation starts with.
#include <numbers>

#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

Vec3 position(const Scene& scene, std::int64_t particle) {
  return block3(scene.simulation->state().positions, particle);
}
Vec3 velocity(const Scene& scene, std::int64_t particle) {
  return block3(scene.simulation->state().velocities, particle);
}
constexpr std::int64_t cloth = 12;  // the first particle of the cloth

TEST(Scene, HasTheDocumentedDefaults) {
  const Scene scene = loaded(changed("gravity = [0.0, 0.0, -9.81]\n[time]\nstep = 0.001\n", "\n"));
  const Settings& settings = scene.simulation->settings();
  EXPECT_EQ(scene.description, "");
  EXPECT_EQ(scene.simulation->model().gravity, Vec3(0, 0, 0));
  EXPECT_EQ(settings.time.step, 1e-3);
  EXPECT_EQ(settings.time.integrator, "symplectic_euler");
  EXPECT_EQ(settings.time.substeps, 1);
  EXPECT_FALSE(settings.time.duration);
  EXPECT_EQ(settings.solver.linear, "auto");
  EXPECT_EQ(settings.solver.linear_tolerance, 1e-6);
  EXPECT_EQ(settings.solver.newton_iterations, 20);
  EXPECT_EQ(settings.solver.newton_tolerance, 1e-8);
  EXPECT_EQ(settings.solver.iterations, 10);
  EXPECT_EQ(settings.stream.fields, std::vector<std::string>{"positions"});
  EXPECT_EQ(settings.stream.precision, "float32");
  EXPECT_EQ(settings.stream.every, 1);
  const Body& body = scene.simulation->model().bodies[1];
  EXPECT_EQ(body.damping, 0.0);
  EXPECT_EQ(body.mass_damping, 0.0);
  EXPECT_EQ(body.drag, 0.0);
  EXPECT_EQ(scene.simulation->model().external_forces.size(), 0);
  EXPECT_TRUE(scene.simulation->model().obstacles.empty());
  EXPECT_TRUE(scene.simulation->model().handles.empty());
  EXPECT_TRUE(scene.simulation->model().midsides.empty());
}

TEST(Scene, CarriesWhatItsFileSays) {
  const std::string tables =
      "step = 2\nintegrator = \"rk4\"\nsubsteps = 7\nduration = 4.5\n"
      "[solver]\nlinear = \"pcg\"\nlinear_tolerance = 1e-9\nnewton_iterations = 1\nnewton_tolerance = 1e-4\niterations "
      "= 3\n"
      "[stream]\nfields = [\"velocities\", \"positions\", \"stretch\", \"stress\"]\nprecision = \"quantized16\"\nevery "
      "= "
      "3\n";
  const std::string described = changed("gravity", "description = \"two bodies\"\ngravity");
  const Scene scene = loaded(changed("step = 0.001\n", tables, described));
  const Settings& settings = scene.simulation->settings();
  EXPECT_EQ(scene.name, "test");
  EXPECT_EQ(scene.description, "two bodies");
  EXPECT_EQ(settings.time.step, 2.0);
  EXPECT_EQ(settings.time.integrator, "rk4");
  EXPECT_EQ(settings.time.substeps, 7);
  EXPECT_EQ(settings.time.duration, 4.5);
  EXPECT_EQ(settings.solver.linear, "pcg");
  EXPECT_EQ(settings.solver.linear_tolerance, 1e-9);
  EXPECT_EQ(settings.solver.newton_iterations, 1);
  EXPECT_EQ(settings.solver.newton_tolerance, 1e-4);
  EXPECT_EQ(settings.solver.iterations, 3);
  EXPECT_EQ(settings.stream.fields, (std::vector<std::string>{"velocities", "positions", "stretch", "stress"}));
  EXPECT_EQ(settings.stream.precision, "quantized16");
  EXPECT_EQ(settings.stream.every, 3);
}

TEST(Scene, BodiesFollowOneAnotherInTheWorld) {
  const Scene scene = loaded(valid_scene);
  const Model& model = scene.simulation->model();
  ASSERT_EQ(model.bodies.size(), 2u);
  EXPECT_EQ(model.bodies[0].particles.count, 12);
  EXPECT_EQ(model.bodies[0].tetrahedra.count, 12);
  EXPECT_EQ(model.bodies[0].springs.count, 0);
  EXPECT_EQ(model.bodies[0].law, find_law("linear"));
  EXPECT_EQ(model.bodies[1].particles.first, 12);
  EXPECT_EQ(model.bodies[1].particles.count, 9);
  EXPECT_EQ(model.bodies[1].tetrahedra.count, 0);
  EXPECT_EQ(model.bodies[1].springs.count, 12 + 8 + 6);
  for (const Spring& spring : model.springs) EXPECT_GE(spring[0], 12);
  EXPECT_EQ(model.masses[12], 0.1);
  EXPECT_DOUBLE_EQ(model.masses.head(12).sum(), 2000.0);
}

TEST(Scene, TotalMassIsSharedEvenly) {
  const Scene scene = loaded(changed("mass = 0.1", "total_mass = 1.8"));
  for (int i = 12; i < 21; ++i) EXPECT_DOUBLE_EQ(scene.simulation->model().masses[i], 0.2);
}

TEST(Scene, ParticleMassOverridesAndTheLastOneWins) {
  const std::string masses =
      "particle_mass = [ { select = { nodes = [0, 1] }, value = 5.0 }, { select = { nodes = [1] }, value = 7.0 } ]\n";
  const Scene scene = loaded(changed("model = \"fem\"\n", "model = \"fem\"\n" + masses));
  EXPECT_EQ(scene.simulation->model().masses[0], 5.0);
  EXPECT_EQ(scene.simulation->model().masses[1], 7.0);
}

TEST(Scene, RotatesThenMoves) {
  const Scene scene = loaded(with_spring_lines("origin = [1.0, 2.0, 3.0]\nrotation = [0.0, 0.0, 1.5707963267948966]"));
  EXPECT_LT((position(scene, cloth) - Vec3(1, 2, 3)).norm(), 1e-15);
  EXPECT_LT((position(scene, cloth + 2) - Vec3(1, 3, 3)).norm(), 1e-15);
}

TEST(Scene, PlacesExactlyWithoutRotation) {
  const Scene scene = loaded(valid_scene);
  EXPECT_EQ(position(scene, cloth + 8), Vec3(1, 1, 0));
}

TEST(Scene, PinsHoldAtRestPlusDisplacementAndUniteTheirAxes) {
  const Scene scene = loaded(with_spring_lines(
      "pin = [ { select = { nodes = [0] }, axes = \"z\" }, { select = { nodes = [0, 1] }, axes = \"x\" } ]\n"
      "displacement = [ { select = { nodes = [0] }, value = [0.5, 0.0, 0.25] } ]\n"
      "velocity = [ { select = { all = true }, value = [1.0, 2.0, 3.0] } ]\n"));
  const auto& fixed = scene.simulation->model().fixed;
  EXPECT_EQ((std::vector<int>(fixed.begin() + 36, fixed.begin() + 42)), (std::vector<int>{1, 0, 1, 1, 0, 0}));
  EXPECT_EQ(position(scene, cloth), Vec3(0.5, 0, 0.25));
  EXPECT_EQ(velocity(scene, cloth), Vec3(0, 2, 0));
  EXPECT_EQ(velocity(scene, cloth + 1), Vec3(0, 2, 3));
  EXPECT_EQ(velocity(scene, cloth + 2), Vec3(1, 2, 3));
  EXPECT_EQ(Vec3(block3(scene.simulation->model().rest_positions, cloth)), Vec3(0, 0, 0));
}

TEST(Scene, PinAxesAreLettersEachOnce) {
  for (const std::string axes : {"", "w", "xx", "xyzx"}) {
    const std::string message =
        refusal(with_spring_lines("pin = [ { select = { all = true }, axes = \"" + axes + "\" } ]"));
    EXPECT_TRUE(message.starts_with("test.toml:16: [[body]] \"cloth\": pin[0].axes = \"" + axes + "\" is ")) << message;
    EXPECT_TRUE(message.ends_with("(allowed: some of the letters x, y and z, each once)")) << message;
  }
}

TEST(Scene, SpinTurnsTheDisplacedShapeAboutItsPoint) {
  const Scene scene =
      loaded(with_spring_lines("displacement = [ { select = { nodes = [2] }, value = [1.0, 0.0, 0.0] } ]\n"
                               "velocity = [ { select = { all = true }, value = [0.0, 0.0, 1.0], spin = [0.0, 0.0, "
                               "4.0], about = [0.0, 1.0, 0.0] } ]\n"));
  EXPECT_EQ(velocity(scene, cloth), Vec3(4, 0, 1));
  EXPECT_EQ(velocity(scene, cloth + 2), Vec3(4, 8, 1));  // at (2, 0, 0)
}

TEST(Scene, EntriesOfTheSameParticleAddUp) {
  const std::string twice =
      " = [ { select = { nodes = [4] }, value = [1.0, 0.0, 0.0] }, { select = { all = true }, "
      "value = [0.0, 2.0, 0.0] } ]\n";
  const Scene scene = loaded(with_spring_lines("force" + twice + "velocity" + twice + "displacement" + twice));
  const VecX& forces = scene.simulation->model().external_forces;
  EXPECT_EQ(Vec3(block3(forces, cloth + 4)), Vec3(1, 2, 0));
  EXPECT_EQ(Vec3(block3(forces, cloth)), Vec3(0, 2, 0));
  EXPECT_EQ(Vec3(block3(forces, 0)), Vec3(0, 0, 0));
  EXPECT_EQ(velocity(scene, cloth + 4), Vec3(1, 2, 0));
  EXPECT_EQ(position(scene, cloth + 4), Vec3(1.5, 2.5, 0));
}

TEST(Scene, ProbesTakeTheNearestParticleAndTheLowestNumberOnATie) {
  const auto probed = [](const std::string& place) {
    return loaded(changed("at = [2.0, 0.0, 0.0]", place)).simulation->probes().at(0).particle;
  };
  EXPECT_EQ(probed("at = [2.1, 0.1, 0.0]"), 2);
  EXPECT_EQ(probed("at = [0.5, 0.0, 0.0]"), 0);
  EXPECT_EQ(probed("at = [1e12, 0.0, 0.0]"), 2);
  EXPECT_EQ(probed("node = 7"), 7);
  EXPECT_EQ(loaded(changed("body = \"beam\"\nat = [2.0, 0.0, 0.0]", "body = \"cloth\"\nnode = 3"))
                .simulation->probes()
                .at(0)
                .particle,
            cloth + 3);
}

TEST(Scene, SpringBodiesMayBeMadeOfTheEdgesOfTetrahedra) {
  const Scene scene = loaded(changed("shape = \"grid\", cells = [2, 2], size = [1.0, 1.0]",
                                     "shape = \"beam\", cells = [1, 1, 1], size = [1.0, 1.0, 1.0]"));
  const Body& body = *find_body(scene.simulation->model(), "cloth");
  EXPECT_EQ(body.springs.count, 12 + 6 + 1);
  EXPECT_EQ(body.tetrahedra.count, 0);
  EXPECT_GT(body.triangles.count, 0);
}

TEST(Scene, CarriesItsTextItsOverridesAndItsMeshFiles) {
  const std::string text = changed("{ shape = \"grid\", cells = [2, 2], size = [1.0, 1.0] }",
                                   "{ file = \"meshes/bunny.ele\", scale = 10.0 }");
  const Scene scene = loaded(text, {"cloth.mass=0.2"});
  EXPECT_EQ(scene.text, text);
  EXPECT_EQ(scene.overrides, std::vector<std::string>{"cloth.mass=0.2"});
  ASSERT_EQ(scene.files.size(), 2u);
  for (const SceneAttachment& file : scene.files) {
    EXPECT_TRUE(file.name == "meshes/bunny.node" || file.name == "meshes/bunny.ele") << file.name;
    EXPECT_GT(file.content.size(), 1000u);
  }
  const Body& body = *find_body(scene.simulation->model(), "cloth");
  double top = 0.0;
  for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i)
    top = std::max(top, position(scene, i).z());
  EXPECT_NEAR(top, 1.545, 0.01);
}

TEST(Scene, OfATinyWorldIsTheScaledOne) {
  const Scene tiny = loaded(changed("size = [2.0, 1.0, 1.0]", "size = [2e-6, 1e-6, 1e-6]"));
  EXPECT_NEAR(tiny.simulation->model().masses.head(12).sum(), 2e-15, 1e-28);
}

}  // namespace
}  // namespace flexcast::test
