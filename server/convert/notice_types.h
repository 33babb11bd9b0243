// What the world tells besides frames and status: few, in order, never dropped.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/scene.h"
#include "core/sim/parameters.h"
#include "core/sim/settings.h"
#include "server/convert/command_types.h"

namespace flexcast::server {

// A new run: scene and topology are published under its id.
struct RunStarted {
  std::uint64_t run_id = 0;
  std::uint64_t topology_revision = 1;
  double time_step = 0.0;  // s, at the start of the run
  StreamSettings stream;
  // Shared with the world, which may have loaded another scene by the time this one is published. Read while the world
  // runs: only what no parameter changes (names, ranges, rest positions, connections).
  std::shared_ptr<const Scene> scene;
};

struct ParametersChanged {
  std::uint64_t run_id = 0;
  std::int64_t step = 0;  // the values hold from this step on
  std::uint64_t parameter_revision = 0;
  std::vector<ParameterDescriptor> descriptors;
  std::vector<ParameterAssignment> values;
};

enum class EventKind { command, state, choice, warning };

struct Event {
  std::uint64_t run_id = 0;
  std::uint64_t index = 0;  // 0, 1, 2, ... within a run
  std::int64_t step = 0;    // it took effect between this step and the next
  double time = 0.0;        // s
  EventKind kind = EventKind::state;
  WorldState state = WorldState::paused;  // after the event
  std::uint64_t parameter_revision = 0;
  RequestKey key;                             // of the command; client_id "" for the server's own
  CommandKind command = CommandKind::status;  // EventKind::command only
  // set: what was set; reset that keeps parameters: what was kept; restore: left_step, the step the world was at
  // before; choice: time.substeps and solver.iterations as they are taken from then on.
  std::vector<ParameterAssignment> values;
  bool keep_parameters = false;
  std::string name;            // load: of the scene; save, restore: of the checkpoint
  std::int64_t particle = 0;   // grab, release
  Vec3 target = Vec3::Zero();  // grab: m
  double stiffness = 0.0;      // grab: N/m, as it is in force
  std::string text;            // for people
};

using Notice = std::variant<RunStarted, ParametersChanged, Event>;

}  // namespace flexcast::server
