#include "clients/replay/publications.h"

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
  dispose_topology(std::string(wire::text(scene.world)),
                   [&](std::uint32_t body, std::uint32_t) { return body >= scene.bodies._length; });
}

void Publications::note(const flexcast_Topology& topology) {
  dispose_topology(std::string(wire::text(topology.world)), [&](std::uint32_t body, std::uint32_t chunk) {
    return body == topology.body && chunk >= topology.chunks;
  });
  topology_.emplace(topology.body, topology.chunk);
}

void Publications::note(const flexcast_ParticleFrame& frame) {
  frame_chunks_.insert(frame.chunk);
}

// Those parts for which `gone(body, chunk)` is true.
template <class Gone>
void Publications::dispose_topology(const std::string& world, Gone gone) {
  wire::Owned<flexcast_Topology> topology;
  wire::set_string(topology->world, world);
  std::erase_if(topology_, [&](const auto& part) {
    if (!gone(part.first, part.second)) return false;
    topology->body = part.first;
    topology->chunk = part.second;
    (void)writers_.topology.dispose(*topology);
    return true;
  });
}

void Publications::dispose(const std::string& world) {
  const auto dispose_one = [&](const auto& writer, auto message) {
    wire::set_string(message->world, world);
    (void)writer.dispose(*message);
  };
  for (const std::uint32_t chunk : frame_chunks_) {
    wire::Owned<flexcast_ParticleFrame> frame;
    frame->chunk = chunk;
    dispose_one(writers_.frames, std::move(frame));
  }
  dispose_topology(world, [](std::uint32_t, std::uint32_t) { return true; });
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
