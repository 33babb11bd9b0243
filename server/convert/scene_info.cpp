#include "server/convert/scene_info.h"

#include <algorithm>

#include "core/sim/chunks.h"
#include "idl/wire/fill.h"

namespace flexcast::server {
namespace {

void fill_body(const Body& body, flexcast_BodyInfo& message) {
  wire::set_string(message.name, body.name);
  wire::set_string(message.model, body.tetrahedra.count > 0 ? "fem" : "mass_spring");  // the law may be changing
  message.first_particle = static_cast<std::uint32_t>(body.particles.first);
  message.particles = static_cast<std::uint32_t>(body.particles.count);
  message.tetrahedra = static_cast<std::uint32_t>(body.tetrahedra.count);
  message.springs = static_cast<std::uint32_t>(body.springs.count);
}

// Shows the chunk's run of `range` of elements made of N particle numbers each.
template <std::size_t N>
void view_elements(const std::vector<std::array<std::int32_t, N>>& elements, IndexRange range, std::uint32_t chunk,
                   std::uint32_t chunks, dds_sequence_unsigned_long& sequence) {
  const ChunkRun run = chunk_run(static_cast<std::size_t>(range.count), chunk, chunks);
  if (run.count == 0) return;
  const auto* first = reinterpret_cast<const std::uint32_t*>(elements[range.first + run.first].data());
  wire::view(sequence, std::span<const std::uint32_t>(first, N * run.count));
}

}  // namespace

wire::Owned<flexcast_SceneInfo> make_scene_info(const RunStarted& run, std::string_view world) {
  const Scene& scene = *run.scene;
  const Model& model = scene.simulation->model();
  wire::Owned<flexcast_SceneInfo> message;
  wire::set_string(message->world, world);
  message->run_id = run.run_id;
  message->topology_revision = run.topology_revision;
  wire::set_string(message->name, scene.name);
  wire::set_string(message->description, scene.description);
  wire::set_string(message->version, FLEXCAST_VERSION);
  message->particles = static_cast<std::uint32_t>(model.particle_count());
  message->time_step = run.time_step;
  message->publish_every = static_cast<std::uint32_t>(run.stream.every);
  wire::set_string(message->precision, run.stream.precision);
  wire::set_strings(message->fields, run.stream.fields);
  const auto bodies = wire::resize(message->bodies, model.bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) fill_body(model.bodies[i], bodies[i]);
  const auto& watched = scene.simulation->probes();
  const auto probes = wire::resize(message->probes, watched.size());
  for (std::size_t i = 0; i < probes.size(); ++i) {
    wire::set_string(probes[i].name, watched[i].name);
    wire::set_string(probes[i].body, watched[i].body);
    probes[i].particle = static_cast<std::uint32_t>(watched[i].particle);
  }
  wire::set_string(message->scene_text, scene.text);
  wire::set_strings(message->overrides, scene.overrides);
  const auto files = wire::resize(message->files, scene.files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& content = scene.files[i].content;
    wire::set_string(files[i].name, scene.files[i].name);
    wire::copy(files[i].content,
               std::span<const std::uint8_t>(reinterpret_cast<const std::uint8_t*>(content.data()), content.size()));
  }
  return message;
}

std::uint32_t count_topology_chunks(const Body& body) {
  const auto bytes =
      static_cast<std::size_t>(body.particles.count) * 3 * sizeof(double) +
      (static_cast<std::size_t>(body.tetrahedra.count) * 4 + static_cast<std::size_t>(body.springs.count) * 2 +
       static_cast<std::size_t>(body.triangles.count) * 3) *
          sizeof(std::uint32_t);
  return count_chunks(bytes, 1);
}

wire::Owned<flexcast_Topology> make_topology(const RunStarted& run, std::string_view world, std::size_t body,
                                             std::uint32_t chunk) {
  const Model& model = run.scene->simulation->model();
  const Body& b = model.bodies[body];
  const std::uint32_t chunks = count_topology_chunks(b);
  wire::Owned<flexcast_Topology> message;
  wire::set_string(message->world, world);
  message->run_id = run.run_id;
  message->topology_revision = run.topology_revision;
  message->body = static_cast<std::uint32_t>(body);
  message->chunk = chunk;
  message->chunks = chunks;
  const ChunkRun particles = chunk_run(static_cast<std::size_t>(b.particles.count), chunk, chunks);
  const double* rest =
      model.rest_positions.data() + 3 * (static_cast<std::size_t>(b.particles.first) + particles.first);
  wire::view(message->rest_positions, std::span<const double>(rest, 3 * particles.count));
  view_elements(model.tetrahedra, b.tetrahedra, chunk, chunks, message->tetrahedra);
  view_elements(model.springs, b.springs, chunk, chunks, message->springs);
  view_elements(model.triangles, b.triangles, chunk, chunks, message->triangles);
  return message;
}

}  // namespace flexcast::server
