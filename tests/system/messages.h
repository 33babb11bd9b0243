// The messages of a recording as tests look at them, decoded from the bytes in the file.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "idl/wire/types.h"

namespace flexcast::test {

struct ParameterMessage {  // a value
  std::string name;
  flexcast_ValueKind kind;
  std::vector<double> numbers;
  std::string text;

  bool operator==(const ParameterMessage&) const = default;
};

struct ParameterSetMessage {
  std::string world;
  std::uint64_t run_id, step, parameter_revision;
  std::vector<std::string> descriptors;  // names
  std::vector<ParameterMessage> values;

  const ParameterMessage& value(const std::string& name) const;  // throws if it is not there
};

struct SceneMessage {
  struct Body {
    std::string name, model;
    std::uint32_t first_particle, particles, tetrahedra, springs;
  };
  struct File {
    std::string name;
    std::vector<std::uint8_t> content;
  };
  std::string world;
  std::uint64_t run_id, topology_revision;
  std::string name, description, version;
  std::uint32_t particles;
  double time_step;
  std::string precision;
  std::vector<std::string> fields;
  std::vector<Body> bodies;
  std::string scene_text;
  std::vector<std::string> overrides;
  std::vector<File> files;
};

struct TopologyMessage {
  std::uint64_t run_id, topology_revision;
  std::uint32_t body, chunk, chunks;
  std::string world;
  std::vector<double> rest_positions;
  std::vector<std::uint32_t> tetrahedra, springs, triangles;
};

// One sample: a frame or a chunk of one.
struct FrameMessage {
  std::uint32_t sequence;  // of the MCAP message
  std::uint64_t run_id, frame, step;
  double time;
  std::uint64_t parameter_revision, topology_revision, state_hash;
  std::uint32_t chunk, chunks, first, total;
  std::array<double, 6> bounds;
  std::string world;
  std::vector<float> positions, velocities;
  std::vector<double> positions64, velocities64;
  std::vector<std::uint16_t> positions16;
  std::vector<float> stretch, stress;
};

struct StatusMessage {
  std::string world;
  std::uint64_t run_id;
  flexcast_WorldState state;
  std::uint64_t heartbeat, step;
};

struct EventMessage {
  std::string world;
  std::uint64_t run_id, index, step;
  double time;
  flexcast_EventKind kind;
  flexcast_WorldState state;
  std::uint64_t parameter_revision;
  std::string client_id;
  std::uint64_t request_id;
  flexcast_CommandKind command_kind;
  std::vector<ParameterMessage> values;
  bool keep_parameters;
  std::string name, text;
};

struct CommandMessage {
  std::string world, client_id;
  std::uint64_t request_id;
  flexcast_CommandKind kind;
};

struct ReplyMessage {
  std::string world, client_id;
  std::uint64_t request_id;
  flexcast_CommandKind kind;
  flexcast_ReplyOutcome outcome;
  std::string reason;
  std::uint64_t run_id, applied_step;
};

using Bytes = std::span<const std::byte>;

// Each throws when the bytes are not exactly such a message; of Status, Command and Reply only the beginning is read.
SceneMessage decode_scene(Bytes message);
TopologyMessage decode_topology(Bytes message);
ParameterSetMessage decode_parameter_set(Bytes message);
FrameMessage decode_frame(Bytes message, std::uint32_t sequence);
StatusMessage decode_status(Bytes message);
EventMessage decode_event(Bytes message);
CommandMessage decode_command(Bytes message);
ReplyMessage decode_reply(Bytes message);

}  // namespace flexcast::test
