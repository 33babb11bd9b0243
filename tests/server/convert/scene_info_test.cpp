#include "server/convert/scene_info.h"

#include <gtest/gtest.h>

#include "core/sim/chunks.h"
#include "idl/wire/fill.h"
#include "tests/support/scene.h"

namespace flexcast::server {
namespace {

std::string beam_scene(const std::string& cells) {
  return R"(name = "beams"
[time]
step = 0.001
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [3], size = [1.0] }
springs = { stiffness = 100.0, damping = 0.1 }
mass = 0.01
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = )" +
         cells + R"(, size = [1.0, 0.2, 0.2] }
material = { law = "corotational", young = 1e5, poisson = 0.3, density = 1000.0 }
)";
}

RunStarted start_run(const std::string& text) {
  Result<Scene> scene = load_scene_text(text);
  if (!scene) throw std::runtime_error(scene.error().message);
  scene.value().overrides = {"a=1"};
  scene.value().files = {{"a.msh", std::string("\0\1\2", 3)}};
  RunStarted run;
  run.run_id = 9;
  run.time_step = 0.001;
  run.scene = std::make_shared<const Scene>(std::move(scene).value());
  return run;
}

TEST(SceneInfo, NamesBodiesWithTheirParticleRanges) {
  const auto message = make_scene_info(start_run(beam_scene("[2, 1, 1]")), "w");
  EXPECT_EQ(message->run_id, 9u);
  EXPECT_EQ(message->topology_revision, 1u);
  EXPECT_EQ(message->particles, 4u + 12u);
  ASSERT_EQ(message->bodies._length, 2u);
  EXPECT_EQ(wire::text(message->bodies._buffer[0].model), "mass_spring");
  EXPECT_EQ(message->bodies._buffer[0].springs, 3u);
  EXPECT_EQ(wire::text(message->bodies._buffer[1].model), "fem");
  EXPECT_EQ(message->bodies._buffer[1].first_particle, 4u);
  EXPECT_EQ(message->bodies._buffer[1].tetrahedra, 12u);
  ASSERT_EQ(message->files._length, 1u);
  EXPECT_EQ(message->files._buffer[0].content._length, 3u);
  EXPECT_EQ(wire::text(message->scene_text), beam_scene("[2, 1, 1]"));
  EXPECT_EQ(wire::strings(message->overrides), std::vector<std::string>{"a=1"});
}

TEST(Topology, ChunksCoverEveryElementExactlyOnceAndStayBelowOneMebibyte) {
  const RunStarted run = start_run(beam_scene("[32, 18, 18]"));
  const Model& model = run.scene->simulation->model();
  const Body& body = model.bodies[1];
  const std::uint32_t chunks = count_topology_chunks(body);
  EXPECT_EQ(count_topology_chunks(model.bodies[0]), 1u);
  ASSERT_GT(chunks, 1u);
  std::vector<double> rest;
  std::vector<std::uint32_t> tetrahedra;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
    const auto message = make_topology(run, "w", 1, chunk);
    EXPECT_EQ(message->chunks, chunks);
    EXPECT_EQ(message->body, 1u);
    const auto append = [](auto& all, const auto& sequence) {
      const auto part = wire::elements(sequence);
      all.insert(all.end(), part.begin(), part.end());
      return part.size_bytes();
    };
    const std::size_t bytes = append(rest, message->rest_positions) + append(tetrahedra, message->tetrahedra) +
                              append(triangles, message->triangles);
    EXPECT_LE(bytes, chunk_bytes - 256);
    EXPECT_EQ(message->springs._length, 0u);
  }
  ASSERT_EQ(rest.size(), 3u * static_cast<std::size_t>(body.particles.count));
  for (std::size_t i = 0; i < rest.size(); ++i) {
    ASSERT_EQ(rest[i], model.rest_positions[3 * body.particles.first + static_cast<Eigen::Index>(i)]);
  }
  ASSERT_EQ(tetrahedra.size(), 4u * static_cast<std::size_t>(body.tetrahedra.count));
  for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
    ASSERT_EQ(static_cast<std::int32_t>(tetrahedra[i]), model.tetrahedra[body.tetrahedra.first + i / 4][i % 4]);
  }
  EXPECT_EQ(triangles.size(), 3u * static_cast<std::size_t>(body.triangles.count));
}

TEST(Topology, QuadraticTetrahedraShowTheirCornersAndTheSurfaceWithItsMidsideNodes) {
  std::string text = beam_scene("[2, 1, 1]");
  const RunStarted linear = start_run(text);
  const RunStarted quadratic = start_run(text + "element = \"tet10\"\n");
  const auto coarse = make_topology(linear, "w", 1, 0);
  const auto fine = make_topology(quadratic, "w", 1, 0);
  const auto corners = wire::elements(fine->tetrahedra);
  ASSERT_EQ(corners.size(), 4u * 12u);
  EXPECT_TRUE(std::equal(corners.begin(), corners.end(), wire::elements(coarse->tetrahedra).begin()));
  EXPECT_EQ(fine->triangles._length, 4 * coarse->triangles._length);
  const auto info = make_scene_info(quadratic, "w");
  const auto& body = info->bodies._buffer[1];
  EXPECT_EQ(wire::text(body.model), "fem");
  EXPECT_EQ(body.tetrahedra, 12u);
  EXPECT_GT(body.particles, 12u);
  EXPECT_EQ(fine->rest_positions._length, 3 * body.particles);
  std::uint32_t highest = 0;
  for (const std::uint32_t particle : wire::elements(fine->triangles)) {
    EXPECT_GE(particle, body.first_particle);
    highest = std::max(highest, particle);
  }
  EXPECT_GE(highest, body.first_particle + 12) << "midside nodes follow the corners";
  EXPECT_LT(highest, body.first_particle + body.particles);
}

}  // namespace
}  // namespace flexcast::server
