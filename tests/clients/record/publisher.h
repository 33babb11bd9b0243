// Publisher: what a server puts on the network, sample by sample as a test asks for it.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "idl/wire/fill.h"
#include "idl/wire/writer.h"
#include "tests/support/network.h"

namespace flexcast::record::test {

class Publisher {
 public:
  // With a status and a scene whose file says `scene_text`.
  explicit Publisher(std::string world, const std::string& scene_text = "name = \"drop\"\n")
      : world_(std::move(world)) {
    publish_status();
    publish_scene(scene_text);
  }

  void publish_status() const {
    const auto status = make<flexcast_Status>();
    write(statuses_, *status);
  }

  void publish_scene(const std::string& text, const std::string& mesh = "") const {
    auto scene = make<flexcast_SceneInfo>();
    wire::set_string(scene->name, "drop");
    wire::set_string(scene->version, "9.8.7");
    wire::set_string(scene->scene_text, text);
    if (!mesh.empty()) {
      auto& file = wire::resize(scene->files, 1)[0];
      wire::set_string(file.name, "meshes/ball.msh");
      wire::copy(file.content, std::span(reinterpret_cast<const std::uint8_t*>(mesh.data()), mesh.size()));
    }
    write(scenes_, *scene);
  }

  void publish_topology() const {
    auto topology = make<flexcast_Topology>();
    topology->chunks = 1;
    wire::copy(topology->tetrahedra, std::array<std::uint32_t, 4>{0, 1, 2, 3});
    write(topologies_, *topology);
  }

  void publish_parameters(std::uint64_t revision) const {
    auto parameters = make<flexcast_ParameterSet>();
    parameters->parameter_revision = revision;
    write(parameters_, *parameters);
  }

  void publish_event(std::uint64_t index) const {
    auto event = make<flexcast_Event>();
    event->index = index;
    wire::set_string(event->text, "event " + std::to_string(index));
    write(events_, *event);
  }

  void publish_reply(std::uint64_t request_id) const {
    auto reply = make<flexcast_Reply>();
    wire::set_string(reply->client_id, "me");
    reply->request_id = request_id;
    write(replies_, *reply);
  }

  // Steps of 1 ms, ten to a frame. The positions differ from chunk to chunk.
  void publish_chunk(std::uint64_t run_id, std::uint64_t frame, std::uint32_t chunk, std::uint32_t chunks) const {
    auto sample = make<flexcast_ParticleFrame>();
    sample->run_id = run_id;
    sample->frame = frame;
    sample->step = 10 * frame;
    sample->time = 0.01 * static_cast<double>(frame);
    sample->chunk = chunk;
    sample->chunks = chunks;
    const auto x = static_cast<float>(1000 * frame + chunk);
    wire::copy(sample->positions, std::vector<float>(7 + frame % 5, x));
    write(frames_, *sample);
  }

  // The same with 50 kB of positions that do not compress.
  void publish_large_chunk(std::uint64_t run_id, std::uint64_t frame, std::uint32_t chunk, std::uint32_t chunks) const {
    auto sample = make<flexcast_ParticleFrame>();
    sample->run_id = run_id;
    sample->frame = frame;
    sample->step = 10 * frame;
    sample->time = 0.01 * static_cast<double>(frame);
    sample->chunk = chunk;
    sample->chunks = chunks;
    std::vector<float> positions(12'500);
    std::uint32_t random = static_cast<std::uint32_t>(frame) * 2 + chunk + 1;
    for (float& x : positions) x = static_cast<float>(random = random * 1664525u + 1013904223u);
    wire::copy(sample->positions, positions);
    write(frames_, *sample);
  }

  void publish_frames(std::uint64_t run_id, std::uint64_t first, std::uint64_t last, std::uint32_t chunks = 1) const {
    for (std::uint64_t frame = first; frame <= last; ++frame) {
      for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) publish_chunk(run_id, frame, chunk, chunks);
    }
  }

  const wire::UntypedWriter& frames() const { return frames_; }
  const wire::Participant& participant() const { return participant_; }

 private:
  template <class T>
  wire::Owned<T> make() const {
    wire::Owned<T> message;
    wire::set_string(message->world, world_);
    return message;
  }
  template <class T>
  static void write(const wire::Writer<T>& writer, const T& message) {
    EXPECT_TRUE(writer.write(message).ok());
  }

  std::string world_;
  wire::Participant participant_ = flexcast::test::join_test_domain();
  wire::Writer<flexcast_SceneInfo> scenes_ = wire::Writer<flexcast_SceneInfo>::create(participant_).value();
  wire::Writer<flexcast_Topology> topologies_ = wire::Writer<flexcast_Topology>::create(participant_).value();
  wire::Writer<flexcast_ParameterSet> parameters_ = wire::Writer<flexcast_ParameterSet>::create(participant_).value();
  wire::Writer<flexcast_ParticleFrame> frames_ = wire::Writer<flexcast_ParticleFrame>::create(participant_).value();
  wire::Writer<flexcast_Status> statuses_ = wire::Writer<flexcast_Status>::create(participant_).value();
  wire::Writer<flexcast_Reply> replies_ = wire::Writer<flexcast_Reply>::create(participant_).value();
  wire::Writer<flexcast_Event> events_ = wire::Writer<flexcast_Event>::create(participant_).value();
};

}  // namespace flexcast::record::test
