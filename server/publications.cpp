#include "server/publications.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "idl/wire/fill.h"
#include "idl/wire/memory.h"
#include "server/convert/events.h"
#include "server/convert/parameters.h"
#include "server/convert/scene_info.h"
#include "server/convert/status.h"

namespace flexcast::server {

wire::Result<Publications> Publications::create(const wire::Participant& participant, std::string world,
                                                std::uint64_t server_id, const wire::Qos& frames_qos) {
  wire::keep_freed_memory();
  auto scene = wire::Writer<flexcast_SceneInfo>::create(participant);
  if (!scene) return scene.error();
  auto topology = wire::Writer<flexcast_Topology>::create(participant);
  if (!topology) return topology.error();
  auto parameters = wire::Writer<flexcast_ParameterSet>::create(participant);
  if (!parameters) return parameters.error();
  auto frames = wire::Writer<flexcast_ParticleFrame>::create(participant, frames_qos);
  if (!frames) return frames.error();
  auto status = wire::Writer<flexcast_Status>::create(participant);
  if (!status) return status.error();
  auto events = wire::Writer<flexcast_Event>::create(participant);
  if (!events) return events.error();
  return Publications({std::move(scene).value(), std::move(topology).value(), std::move(parameters).value(),
                       std::move(frames).value(), std::move(status).value(), std::move(events).value()},
                      std::move(world), server_id);
}

Publications::Publications(Writers writers, std::string world, std::uint64_t server_id)
    : writers_(std::move(writers)), world_(std::move(world)), server_id_(server_id), frame_message_(world_) {}

template <class T>
bool Publications::write(const wire::Writer<T>& writer, const T& message) {
  const auto result = writer.write(message);
  if (result) return true;
  const std::string complaint = std::string(wire::topic_of<T>().name) + ": " + result.error().message;
  if (complaints_.insert(complaint).second) spdlog::error("{} (said once)", complaint);
  return false;
}

void Publications::publish(const Notice& notice) {
  std::visit([this](const auto& one) { publish_one(one); }, notice);
}

void Publications::publish_one(const RunStarted& run) {
  spdlog::info("run {} begins", run.run_id);
  write(writers_.scene, *make_scene_info(run, world_));
  std::vector<std::uint32_t> chunks;
  for (const Body& body : run.scene->simulation->model().bodies) chunks.push_back(count_topology_chunks(body));
  dispose_topology(chunks);
  for (std::size_t body = 0; body < chunks.size(); ++body) {
    for (std::uint32_t chunk = 0; chunk < chunks[body]; ++chunk) {
      write(writers_.topology, *make_topology(run, world_, body, chunk));
    }
  }
  topology_chunks_ = std::move(chunks);
}

void Publications::publish_one(const ParametersChanged& parameters) {
  write(writers_.parameters, *to_wire(parameters, world_));
}

void Publications::publish_one(const Event& event) {
  const auto level =
      event.kind == EventKind::warning || event.state == WorldState::failed ? spdlog::level::warn : spdlog::level::info;
  const std::string whose = event.key.client_id.empty() ? "" : " (" + event.key.client_id + ")";
  spdlog::log(level, "step {}: {}{}", event.step, event.text, whose);
  write(writers_.events, *to_wire(event, world_));
}

void Publications::publish(const WorldStatus& status, const DeliveryStatus& delivery) {
  write(writers_.status, *to_wire(status, delivery, {world_, server_id_}));
}

bool Publications::publish(const Frame& frame) {
  if (frame_readers().current == 0) return false;
  frame_message_.assign(frame);
  most_frame_chunks_ = std::max(most_frame_chunks_, frame_message_.chunks());
  bool written = true;
  for (std::uint32_t chunk = 0; chunk < frame_message_.chunks(); ++chunk) {
    written &= write(writers_.frames, frame_message_.chunk(chunk));
  }
  return written;
}

template <class T>
void Publications::dispose(const wire::Writer<T>& writer, T& message) {
  wire::set_string(message.world, world_);
  if (auto result = writer.dispose(message); !result) spdlog::debug("{}", result.error().message);
}

// What was written and is not of the scene that has so many chunks of each body.
void Publications::dispose_topology(const std::vector<std::uint32_t>& still_there) {
  wire::Owned<flexcast_Topology> topology;
  for (std::size_t body = 0; body < topology_chunks_.size(); ++body) {
    topology->body = static_cast<std::uint32_t>(body);
    topology->chunk = body < still_there.size() ? still_there[body] : 0;
    for (; topology->chunk < topology_chunks_[body]; ++topology->chunk) dispose(writers_.topology, *topology);
  }
}

void Publications::dispose() {
  wire::Owned<flexcast_ParticleFrame> frame;
  for (; frame->chunk < most_frame_chunks_; ++frame->chunk) dispose(writers_.frames, *frame);
  dispose_topology({});
  dispose(writers_.parameters, *wire::Owned<flexcast_ParameterSet>());
  dispose(writers_.scene, *wire::Owned<flexcast_SceneInfo>());
  dispose(writers_.events, *wire::Owned<flexcast_Event>());
  dispose(writers_.status, *wire::Owned<flexcast_Status>());
}

}  // namespace flexcast::server
