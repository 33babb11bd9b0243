#include "clients/replay/publications.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "idl/wire/decode.h"

namespace flexcast::replay {

using wire::TopicId;

wire::Result<Publications> Publications::create(const wire::Participant& participant, std::size_t frame_bytes,
                                                Say say) {
  auto scene = wire::Writer<flexcast_SceneInfo>::create(participant);
  if (!scene) return scene.error();
  auto topology = wire::Writer<flexcast_Topology>::create(participant);
  if (!topology) return topology.error();
  auto parameters = wire::Writer<flexcast_ParameterSet>::create(participant);
  if (!parameters) return parameters.error();
  auto frames = wire::Writer<flexcast_ParticleFrame>::create(participant, wire::frames_writer_qos(frame_bytes));
  if (!frames) return frames.error();
  auto status = wire::Writer<flexcast_Status>::create(participant);
  if (!status) return status.error();
  auto events = wire::Writer<flexcast_Event>::create(participant);
  if (!events) return events.error();
  return Publications({std::move(scene).value(), std::move(topology).value(), std::move(parameters).value(),
                       std::move(frames).value(), std::move(status).value(), std::move(events).value()},
                      std::move(say));
}

void Publications::publish(const recording::RecordedMessage& message, const Stamp& stamp) {
  switch (message.topic) {
    case TopicId::scene:
      return publish_as(writers_.scene, message, stamp);
    case TopicId::topology:
      return publish_as(writers_.topology, message, stamp);
    case TopicId::parameters:
      return publish_as(writers_.parameters, message, stamp);
    case TopicId::events:
      return publish_as(writers_.events, message, stamp);
    case TopicId::frames:
      if (frame_readers().current > 0) publish_as(writers_.frames, message, stamp);
      return;
    default:
      return;
  }
}

void Publications::publish(const flexcast_Status& status) {
  if (auto written = writers_.status.write(status); !written) complain(written.error(), "flexcast/status");
}

template <class T>
void Publications::publish_as(const wire::Writer<T>& writer, const recording::RecordedMessage& message,
                              const Stamp& stamp) {
  const char* const topic = wire::topic(message.topic).name;
  auto decoded = wire::decode<T>(message.bytes);
  if (!decoded) return complain(decoded.error(), topic);
  T& sample = *decoded.value();
  if (!restamp(sample, stamp)) return;
  note(sample);
  if (auto written = writer.write(sample); !written) complain(written.error(), topic);
}

// Bodies that the scene does not have any more are gone, as with a server that has loaded it.
void Publications::note(const flexcast_SceneInfo& scene) {
  const auto bodies = scene.bodies._length;
  dispose_topology(std::string(wire::text(scene.world)), bodies, 0, std::numeric_limits<std::uint32_t>::max());
  topology_chunks_.erase(topology_chunks_.lower_bound(bodies), topology_chunks_.end());
}

void Publications::note(const flexcast_Topology& topology) {
  dispose_topology(std::string(wire::text(topology.world)), topology.body, topology.chunks, topology.body + 1);
  std::uint32_t& chunks = topology_chunks_[topology.body];
  chunks = std::max(std::min(chunks, topology.chunks), topology.chunk + 1);
}

void Publications::note(const flexcast_ParticleFrame& frame) {
  most_frame_chunks_ = std::max(most_frame_chunks_, frame.chunk + 1);
}

// Of the bodies in [first_body, end_body) the chunks from first_chunk on.
void Publications::dispose_topology(const std::string& world, std::uint32_t first_body, std::uint32_t first_chunk,
                                    std::uint32_t end_body) {
  wire::Owned<flexcast_Topology> topology;
  wire::set_string(topology->world, world);
  for (auto body = topology_chunks_.lower_bound(first_body); body != topology_chunks_.end() && body->first < end_body;
       ++body) {
    topology->body = body->first;
    for (topology->chunk = first_chunk; topology->chunk < body->second; ++topology->chunk) {
      (void)writers_.topology.dispose(*topology);
    }
  }
}

void Publications::dispose(const std::string& world) {
  const auto dispose_one = [&](const auto& writer, auto message) {
    wire::set_string(message->world, world);
    (void)writer.dispose(*message);
  };
  for (std::uint32_t chunk = 0; chunk < most_frame_chunks_; ++chunk) {
    wire::Owned<flexcast_ParticleFrame> frame;
    frame->chunk = chunk;
    dispose_one(writers_.frames, std::move(frame));
  }
  dispose_topology(world, 0, 0, std::numeric_limits<std::uint32_t>::max());
  dispose_one(writers_.parameters, wire::Owned<flexcast_ParameterSet>());
  dispose_one(writers_.scene, wire::Owned<flexcast_SceneInfo>());
  dispose_one(writers_.events, wire::Owned<flexcast_Event>());
  dispose_one(writers_.status, wire::Owned<flexcast_Status>());
}

void Publications::complain(const wire::Error& error, const char* topic) {
  const std::string complaint = std::string(topic) + ": " + error.message + " (said once)";
  if (complaints_.insert(complaint).second) say_(complaint);
}

}  // namespace flexcast::replay
