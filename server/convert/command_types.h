// What clients ask of a world and what it answers, free of DDS. The kinds are in the order of the contract
// (idl/flexcast.idl); server/convert translates.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/sim/parameters.h"
#include "core/sim/report.h"
#include "server/convert/clock.h"

namespace flexcast::server {

enum class WorldState { running, paused, finished, failed };

enum class CommandKind {
  set,
  get,
  describe,
  reset,
  pause,
  resume,
  step,
  run_until,
  load,
  save,
  restore,
  grab,
  release,
  status
};

enum class Outcome { applied, rejected, unsupported, wrong_state, expired };

// ---- what is asked

struct SetCommand {
  std::vector<ParameterAssignment> values;  // all or nothing
};
struct GetCommand {
  std::vector<std::string> names;  // empty: all
};
struct DescribeCommand {};
struct ResetCommand {
  bool keep_parameters = false;
};
struct PauseCommand {};
struct ResumeCommand {};
struct StepCommand {
  std::uint64_t count = 1;
};
struct RunUntilCommand {
  double time = 0.0;  // s
};
struct LoadCommand {
  std::string name;  // of a scene in the server's folder
};
struct SaveCommand {
  std::string name;  // of a checkpoint
};
struct RestoreCommand {
  std::string name;  // of a checkpoint
};
struct GrabCommand {
  std::int64_t particle = 0;   // of the world
  Vec3 target = Vec3::Zero();  // m
  double stiffness = 0.0;      // N/m; 0: chosen by the engine
};
struct ReleaseCommand {
  std::int64_t particle = 0;  // of the world
};
struct StatusCommand {};
struct MalformedCommand {  // answered `rejected`, in its turn, so that the reply says where the world stands
  std::string reason;
};

using CommandBody = std::variant<SetCommand, GetCommand, DescribeCommand, ResetCommand, PauseCommand, ResumeCommand,
                                 StepCommand, RunUntilCommand, LoadCommand, SaveCommand, RestoreCommand, GrabCommand,
                                 ReleaseCommand, StatusCommand, MalformedCommand>;

// Whose request: replies go back under it, a repeated one is recognised by it.
struct RequestKey {
  std::string client_id;
  std::uint64_t request_id = 0;
};

struct Command {
  RequestKey key;
  CommandKind kind = CommandKind::status;
  std::optional<Clock::time_point> deadline;       // after it the command has expired
  std::optional<std::uint64_t> expected_revision;  // refuse unless this parameter revision is in force
  CommandBody body;
};

// ---- what is answered

// The last step as status and replies show it.
struct MeasuredReport {
  StepReport report;
  double wall_seconds = 0.0;  // of the last step
};

// `run_id`, `applied_step`, `time` and `state` describe one moment: the one at which the effect was complete. The
// command acted between applied_step and the next step; `step` and `run_until` are complete on arrival.
struct Reply {
  RequestKey key;
  CommandKind kind = CommandKind::status;
  Outcome outcome = Outcome::applied;
  std::string reason;  // "" when applied
  std::uint64_t run_id = 0;
  std::int64_t applied_step = 0;
  double time = 0.0;  // s
  WorldState state = WorldState::paused;
  std::uint64_t parameter_revision = 0;
  std::vector<ParameterAssignment> values;       // now in force
  std::vector<ParameterDescriptor> descriptors;  // describe
  std::optional<MeasuredReport> report;          // status and step
};

}  // namespace flexcast::server
