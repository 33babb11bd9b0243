// One filled sample of every topic's type: every string, sequence and number differs from its default.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "idl/wire/fill.h"
#include "idl/wire/owned.h"

namespace flexcast::test {

inline void fill(flexcast_ParameterValue& value, const std::string& name = "beam.young") {
  wire::set_string(value.name, name);
  value.kind = flexcast_VALUE_VECTOR;
  wire::copy(value.numbers, std::array{1.5, -2.5, 1e300});
  wire::set_string(value.text, "text");
}

inline void fill(flexcast_ParameterDescriptor& descriptor) {
  wire::set_string(descriptor.name, "gravity");
  descriptor.kind = flexcast_VALUE_VECTOR;
  wire::set_string(descriptor.unit, "m/s^2");
  fill(descriptor.initial);
  descriptor.minimum = -5;
  descriptor.maximum = 5;
  descriptor.minimum_open = descriptor.maximum_open = descriptor.live = true;
  wire::set_strings(descriptor.choices, std::array<std::string, 2>{"pcg", "ldlt"});
  wire::set_string(descriptor.description, "one line");
}

inline void fill(flexcast_StepReport& report) {
  report.step = 12;
  report.time = 0.5;
  report.kinetic = 1;
  report.momentum[2] = 3;
  report.converged = true;
  report.min_j = 0.25;
  report.substeps = 4;
}

inline void fill(flexcast_SceneInfo& scene) {
  wire::set_string(scene.world, "beam");
  scene.run_id = 7;
  scene.topology_revision = 2;
  wire::set_string(scene.scene_text, "name = \"beam\"\n");
  wire::set_strings(scene.fields, std::array<std::string, 1>{"positions"});
  auto& body = wire::resize(scene.bodies, 1)[0];
  wire::set_string(body.name, "beam");
  body.particles = 27;
  auto& probe = wire::resize(scene.probes, 1)[0];
  wire::set_string(probe.name, "tip");
  auto& file = wire::resize(scene.files, 1)[0];
  wire::set_string(file.name, "mesh.msh");
  wire::copy(file.content, std::array<std::uint8_t, 3>{1, 2, 3});
}

inline void fill(flexcast_Topology& topology) {
  wire::set_string(topology.world, "beam");
  topology.run_id = 7;
  topology.body = 1;
  topology.chunks = 1;
  wire::copy(topology.rest_positions, std::array{0.0, 1.0, 2.0});
  wire::copy(topology.tetrahedra, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  wire::copy(topology.triangles, std::array<std::uint32_t, 3>{0, 1, 2});
}

inline void fill(flexcast_ParameterSet& set) {
  wire::set_string(set.world, "beam");
  set.parameter_revision = 3;
  fill(wire::resize(set.descriptors, 2)[1]);
  fill(wire::resize(set.values, 2)[1]);
}

inline void fill(flexcast_ParticleFrame& frame) {
  frame.run_id = 0x0102030405060708;
  frame.frame = 11;
  frame.step = 22;
  frame.time = 0.022;
  frame.parameter_revision = 3;
  frame.topology_revision = 4;
  frame.state_hash = 0xfedcba9876543210;
  frame.chunk = 1;
  frame.chunks = 2;
  frame.first = 100;
  frame.total = 200;
  for (int i = 0; i < 6; ++i) frame.bounds[i] = i - 2.5;
  wire::set_string(frame.world, "beam");
  wire::copy(frame.positions, std::array{1.0f, 2.0f, 3.0f});
  wire::copy(frame.velocities64, std::array{0.1, 0.2, 0.3});
  wire::copy(frame.positions16, std::array<std::uint16_t, 3>{1, 65535, 7});
  wire::copy(frame.stress, std::array{4.0f});
}

inline void fill(flexcast_Status& status) {
  wire::set_string(status.world, "beam");
  status.state = flexcast_WORLD_FAILED;
  status.heartbeat = 99;
  fill(status.report);
  status.server_id = 5;
  wire::set_string(status.trouble.cause, "inverted");
  status.trouble.element = -1;
  wire::set_string(wire::resize(status.probes, 1)[0].name, "tip");
  wire::set_string(wire::resize(status.handles, 1)[0].name, "grip");
  wire::set_strings(status.warnings, std::array<std::string, 1>{"too stiff"});
  wire::copy(status.unpublished, std::array<std::uint64_t, 2>{3, 7});
}

inline void fill(flexcast_Command& command) {
  wire::set_string(command.world, "beam");
  wire::set_string(command.client_id, "me");
  command.request_id = 8;
  command.kind = flexcast_COMMAND_GRAB;
  command.check_revision = true;
  fill(wire::resize(command.values, 1)[0]);
  command.target[1] = 2;
}

inline void fill(flexcast_Reply& reply) {
  wire::set_string(reply.world, "beam");
  wire::set_string(reply.client_id, "me");
  reply.outcome = flexcast_OUTCOME_REJECTED;
  wire::set_string(reply.reason, "no");
  fill(wire::resize(reply.values, 1)[0]);
  fill(wire::resize(reply.descriptors, 1)[0]);
  fill(reply.report);
}

inline void fill(flexcast_Event& event) {
  wire::set_string(event.world, "beam");
  event.index = 4;
  event.kind = flexcast_EVENT_WARNING;
  fill(wire::resize(event.values, 1)[0]);
  wire::set_string(event.text, "for people");
}

inline void fill(flexcast_RecorderInfo& info) {
  wire::set_string(info.world, "beam");
  wire::set_string(info.recorder_id, "r1");
  info.state = flexcast_RECORDER_FAILED;
  info.next_frame = 100;
  info.request_id = 6;
  wire::set_string(info.file, "run.mcap");
}

inline void fill(flexcast_RecorderCommand& command) {
  wire::set_string(command.world, "beam");
  wire::set_string(command.recorder_id, "r1");
  command.kind = flexcast_RECORDER_STOP;
}

}  // namespace flexcast::test
