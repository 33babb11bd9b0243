#include "server/convert/scene_info.h"

#include <algorithm>

#include "idl/wire/fill.h"
#include "server/convert/chunks.h"

namespace flexcast::server {
namespace {

void fill_body(const Body& body, flexcast_BodyInfo& message) {
  wire::set_string(message.name, body.name);
  wire::set_string(message.model, body.is_fem() ? "fem" : "mass_spring");
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

wire::Owned<flexcast_SceneInfo> make_scene_info(const SceneFacts& facts, const RunStarted& run) {
  wire::Owned<flexcast_SceneInfo> message;
  wire::set_string(message->world, facts.world);
  message->run_id = run.run_id;
  message->topology_revision = run.topology_revision;
  wire::set_string(message->name, facts.name);
  wire::set_string(message->description, facts.description);
  wire::set_string(message->version, FLEXCAST_VERSION);
  message->particles = static_cast<std::uint32_t>(facts.model->particle_count());
  message->time_step = run.time_step;
  message->publish_every = static_cast<std::uint32_t>(run.stream.every);
  wire::set_string(message->precision, run.stream.precision);
  wire::set_strings(message->fields, run.stream.fields);
  const auto bodies = wire::resize(message->bodies, facts.model->bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) fill_body(facts.model->bodies[i], bodies[i]);
  const auto probes = wire::resize(message->probes, facts.probes.size());
  for (std::size_t i = 0; i < probes.size(); ++i) {
    wire::set_string(probes[i].name, facts.probes[i].name);
    wire::set_string(probes[i].body, facts.probes[i].body);
    probes[i].particle = static_cast<std::uint32_t>(facts.probes[i].particle);
  }
  wire::set_string(message->scene_text, facts.text);
  wire::set_strings(message->overrides, facts.overrides);
  const auto files = wire::resize(message->files, facts.files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& content = facts.files[i].content;
    wire::set_string(files[i].name, facts.files[i].name);
    wire::copy(files[i].content,
               std::span<const std::uint8_t>(reinterpret_cast<const std::uint8_t*>(content.data()), content.size()));
  }
  return message;
}

std::uint32_t count_topology_chunks(const SceneFacts& facts, std::size_t body) {
  const Body& b = facts.model->bodies[body];
  const auto bytes = static_cast<std::size_t>(b.particles.count) * 3 * sizeof(double) +
                     (static_cast<std::size_t>(b.tetrahedra.count) * 4 + static_cast<std::size_t>(b.springs.count) * 2 +
                      static_cast<std::size_t>(b.triangles.count) * 3) *
                         sizeof(std::uint32_t);
  return count_chunks(bytes, 1);
}

wire::Owned<flexcast_Topology> make_topology(const SceneFacts& facts, const RunStarted& run, std::size_t body,
                                             std::uint32_t chunk) {
  const Model& model = *facts.model;
  const Body& b = model.bodies[body];
  const std::uint32_t chunks = count_topology_chunks(facts, body);
  wire::Owned<flexcast_Topology> message;
  wire::set_string(message->world, facts.world);
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
