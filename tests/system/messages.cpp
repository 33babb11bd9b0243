#include "tests/system/messages.h"

#include <algorithm>
#include <stdexcept>

#include "tests/support/cdr.h"

namespace flexcast::test {
namespace {

ParameterMessage read_value(Cdr& cdr) {
  ParameterMessage value;
  value.name = cdr.string();
  value.kind = cdr.enumerator<flexcast_ValueKind>();
  value.numbers = cdr.numbers<double>();
  value.text = cdr.string();
  return value;
}

std::vector<ParameterMessage> read_values(Cdr& cdr) {
  return cdr.sequence([&] { return read_value(cdr); });
}

std::string read_descriptor(Cdr& cdr) {
  const std::string name = cdr.string();
  cdr.enumerator<flexcast_ValueKind>();
  cdr.string();  // unit
  read_value(cdr);
  cdr.doubles<2>();  // bounds
  cdr.boolean();     // open
  cdr.boolean();
  cdr.strings();  // choices
  cdr.boolean();  // live
  cdr.string();   // description
  return name;
}

SceneMessage::Body read_body(Cdr& cdr) {
  SceneMessage::Body body;
  body.name = cdr.string();
  body.model = cdr.string();
  for (std::uint32_t* number : {&body.first_particle, &body.particles, &body.tetrahedra, &body.springs}) {
    *number = cdr.u32();
  }
  return body;
}

std::string read_probe(Cdr& cdr) {
  const std::string name = cdr.string();
  cdr.string();  // body
  cdr.u32();     // particle
  return name;
}

SceneMessage::File read_file(Cdr& cdr) {
  std::string name = cdr.string();
  return {std::move(name), cdr.numbers<std::uint8_t>()};
}

}  // namespace

const ParameterMessage& ParameterSetMessage::value(const std::string& name) const {
  const auto found = std::find_if(values.begin(), values.end(), [&](const auto& one) { return one.name == name; });
  if (found == values.end()) throw std::runtime_error("no parameter " + name + " is recorded");
  return *found;
}

SceneMessage decode_scene(Bytes message) {
  Cdr cdr(message);
  SceneMessage scene;
  scene.world = cdr.string();
  scene.run_id = cdr.u64();
  scene.topology_revision = cdr.u64();
  scene.name = cdr.string();
  scene.description = cdr.string();
  scene.version = cdr.string();
  scene.particles = cdr.u32();
  scene.time_step = cdr.f64();
  cdr.u32();  // publish_every
  scene.precision = cdr.string();
  scene.fields = cdr.strings();
  scene.bodies = cdr.sequence([&] { return read_body(cdr); });
  cdr.sequence([&] { return read_probe(cdr); });
  scene.scene_text = cdr.string();
  scene.overrides = cdr.strings();
  scene.files = cdr.sequence([&] { return read_file(cdr); });
  cdr.expect_end();
  return scene;
}

TopologyMessage decode_topology(Bytes message) {
  Cdr cdr(message);
  TopologyMessage topology;
  topology.run_id = cdr.u64();
  topology.topology_revision = cdr.u64();
  topology.body = cdr.u32();
  topology.chunk = cdr.u32();
  topology.chunks = cdr.u32();
  topology.world = cdr.string();
  topology.rest_positions = cdr.numbers<double>();
  topology.tetrahedra = cdr.numbers<std::uint32_t>();
  topology.springs = cdr.numbers<std::uint32_t>();
  topology.triangles = cdr.numbers<std::uint32_t>();
  cdr.expect_end();
  return topology;
}

ParameterSetMessage decode_parameter_set(Bytes message) {
  Cdr cdr(message);
  ParameterSetMessage set;
  set.world = cdr.string();
  set.run_id = cdr.u64();
  set.step = cdr.u64();
  set.parameter_revision = cdr.u64();
  set.descriptors = cdr.sequence([&] { return read_descriptor(cdr); });
  set.values = read_values(cdr);
  cdr.expect_end();
  return set;
}

FrameMessage decode_frame(Bytes message, std::uint32_t sequence) {
  Cdr cdr(message);
  FrameMessage frame;
  frame.sequence = sequence;
  for (std::uint64_t* number : {&frame.run_id, &frame.frame, &frame.step}) *number = cdr.u64();
  frame.time = cdr.f64();
  for (std::uint64_t* number : {&frame.parameter_revision, &frame.topology_revision, &frame.state_hash}) {
    *number = cdr.u64();
  }
  for (std::uint32_t* number : {&frame.chunk, &frame.chunks, &frame.first, &frame.total}) *number = cdr.u32();
  frame.bounds = cdr.doubles<6>();
  frame.world = cdr.string();
  frame.positions = cdr.numbers<float>();
  frame.velocities = cdr.numbers<float>();
  frame.positions64 = cdr.numbers<double>();
  frame.velocities64 = cdr.numbers<double>();
  frame.positions16 = cdr.numbers<std::uint16_t>();
  frame.stretch = cdr.numbers<float>();
  frame.stress = cdr.numbers<float>();
  cdr.expect_end();
  return frame;
}

StatusMessage decode_status(Bytes message) {
  Cdr cdr(message);
  StatusMessage status;
  status.world = cdr.string();
  status.run_id = cdr.u64();
  status.state = cdr.enumerator<flexcast_WorldState>();
  status.heartbeat = cdr.u64();
  status.step = cdr.u64();  // the report begins with it
  return status;
}

EventMessage decode_event(Bytes message) {
  Cdr cdr(message);
  EventMessage event;
  event.world = cdr.string();
  event.run_id = cdr.u64();
  event.index = cdr.u64();
  event.step = cdr.u64();
  event.time = cdr.f64();
  event.kind = cdr.enumerator<flexcast_EventKind>();
  event.state = cdr.enumerator<flexcast_WorldState>();
  event.parameter_revision = cdr.u64();
  event.client_id = cdr.string();
  event.request_id = cdr.u64();
  event.command_kind = cdr.enumerator<flexcast_CommandKind>();
  event.values = read_values(cdr);
  event.keep_parameters = cdr.boolean();
  event.name = cdr.string();
  cdr.u32();         // particle
  cdr.doubles<4>();  // target, stiffness
  event.text = cdr.string();
  cdr.expect_end();
  return event;
}

CommandMessage decode_command(Bytes message) {
  Cdr cdr(message);
  CommandMessage command;
  command.world = cdr.string();
  command.client_id = cdr.string();
  command.request_id = cdr.u64();
  command.kind = cdr.enumerator<flexcast_CommandKind>();
  return command;
}

ReplyMessage decode_reply(Bytes message) {
  Cdr cdr(message);
  ReplyMessage reply;
  reply.world = cdr.string();
  reply.client_id = cdr.string();
  reply.request_id = cdr.u64();
  reply.kind = cdr.enumerator<flexcast_CommandKind>();
  reply.outcome = cdr.enumerator<flexcast_ReplyOutcome>();
  reply.reason = cdr.string();
  reply.run_id = cdr.u64();
  reply.applied_step = cdr.u64();
  return reply;
}

}  // namespace flexcast::test
