#include "server/convert/commands.h"

#include <cmath>

#include "idl/wire/fill.h"
#include "server/convert/enums.h"
#include "server/convert/parameters.h"
#include "server/convert/status.h"

namespace flexcast::server {
namespace {

CommandBody set_from_wire(const flexcast_Command& message) {
  SetCommand set;
  for (const auto& value : wire::elements(message.values)) {
    auto assignment = from_wire(value);
    if (!assignment) return MalformedCommand{assignment.error().message};
    set.values.push_back(std::move(assignment).value());
  }
  return set;
}

CommandBody get_from_wire(const flexcast_Command& message) {
  GetCommand get;
  for (const auto& value : wire::elements(message.values)) get.names.emplace_back(wire::text(value.name));
  return get;
}

CommandBody body_from_wire(const flexcast_Command& message) {
  switch (message.kind) {
    case flexcast_COMMAND_SET:
      return set_from_wire(message);
    case flexcast_COMMAND_GET:
      return get_from_wire(message);
    case flexcast_COMMAND_DESCRIBE:
      return DescribeCommand{};
    case flexcast_COMMAND_RESET:
      return ResetCommand{message.keep_parameters};
    case flexcast_COMMAND_PAUSE:
      return PauseCommand{};
    case flexcast_COMMAND_RESUME:
      return ResumeCommand{};
    case flexcast_COMMAND_STEP:
      return StepCommand{message.count};
    case flexcast_COMMAND_RUN_UNTIL:
      return RunUntilCommand{message.time};
    case flexcast_COMMAND_STATUS:
      return StatusCommand{};
    case flexcast_COMMAND_LOAD:
      return LoadCommand{std::string(wire::text(message.name))};
    case flexcast_COMMAND_SAVE:
      return SaveCommand{std::string(wire::text(message.name))};
    case flexcast_COMMAND_RESTORE:
      return RestoreCommand{std::string(wire::text(message.name))};
    case flexcast_COMMAND_GRAB:
      return GrabCommand{message.particle, Vec3(message.target[0], message.target[1], message.target[2]),
                         message.stiffness};
    case flexcast_COMMAND_RELEASE:
      return ReleaseCommand{message.particle};
  }
  return MalformedCommand{"this kind of command is not known"};
}

}  // namespace

Command from_wire(const flexcast_Command& message, Clock::time_point received) {
  Command command;
  command.key = {std::string(wire::text(message.client_id)), message.request_id};
  command.kind = static_cast<CommandKind>(message.kind);
  if (message.check_revision) command.expected_revision = message.expected_revision;
  if (!std::isfinite(message.expires_in) || message.expires_in < 0.0) {
    command.body = MalformedCommand{"expires_in must be a number of seconds, 0 for never"};
    return command;
  }
  if (message.expires_in > 0.0) command.deadline = received + from_seconds(message.expires_in);
  command.body = body_from_wire(message);
  return command;
}

wire::Owned<flexcast_Reply> to_wire(const Reply& reply, std::string_view world) {
  wire::Owned<flexcast_Reply> message;
  wire::set_string(message->world, world);
  wire::set_string(message->client_id, reply.key.client_id);
  message->request_id = reply.key.request_id;
  message->kind = to_wire(reply.kind);
  message->outcome = to_wire(reply.outcome);
  wire::set_string(message->reason, reply.reason);
  message->run_id = reply.run_id;
  message->applied_step = static_cast<std::uint64_t>(reply.applied_step);
  message->time = reply.time;
  message->state = to_wire(reply.state);
  message->parameter_revision = reply.parameter_revision;
  to_wire(std::span<const ParameterAssignment>(reply.values), message->values);
  to_wire(std::span<const ParameterDescriptor>(reply.descriptors), message->descriptors);
  if (reply.report) message->report = to_wire(*reply.report);
  return message;
}

}  // namespace flexcast::server
