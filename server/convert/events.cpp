#include "server/convert/events.h"

#include <algorithm>

#include "idl/wire/fill.h"
#include "server/convert/enums.h"
#include "server/convert/parameters.h"

namespace flexcast::server {

wire::Owned<flexcast_Event> to_wire(const Event& event, std::string_view world) {
  wire::Owned<flexcast_Event> message;
  wire::set_string(message->world, world);
  message->run_id = event.run_id;
  message->index = event.index;
  message->step = static_cast<std::uint64_t>(event.step);
  message->time = event.time;
  message->kind = to_wire(event.kind);
  message->state = to_wire(event.state);
  message->parameter_revision = event.parameter_revision;
  wire::set_string(message->client_id, event.key.client_id);
  message->request_id = event.key.request_id;
  message->command_kind = to_wire(event.command);
  to_wire(std::span<const ParameterAssignment>(event.values), message->values);
  message->keep_parameters = event.keep_parameters;
  wire::set_string(message->name, event.name);
  message->particle = static_cast<std::uint32_t>(event.particle);
  std::copy_n(event.target.data(), 3, message->target);
  message->stiffness = event.stiffness;
  wire::set_string(message->text, event.text);
  return message;
}

Result<Event> from_wire(const flexcast_Event& message) {
  const std::string name = "event " + std::to_string(message.index);
  if (number_of(message.kind) > flexcast_EVENT_WARNING || number_of(message.state) > flexcast_WORLD_FAILED ||
      number_of(message.command_kind) > flexcast_COMMAND_STATUS) {
    return Error{name + " is of a kind that is not known"};
  }
  Event event;
  event.run_id = message.run_id;
  event.index = message.index;
  event.step = static_cast<std::int64_t>(message.step);
  event.time = message.time;
  event.kind = static_cast<EventKind>(message.kind);
  event.state = static_cast<WorldState>(message.state);
  event.parameter_revision = message.parameter_revision;
  event.key = {std::string(wire::text(message.client_id)), message.request_id};
  event.command = static_cast<CommandKind>(message.command_kind);
  for (const auto& value : wire::elements(message.values)) {
    auto assignment = from_wire(value);
    if (!assignment) return Error{name + ": " + assignment.error().message};
    event.values.push_back(std::move(assignment).value());
  }
  event.keep_parameters = message.keep_parameters;
  event.name = wire::text(message.name);
  event.particle = message.particle;
  event.target = Vec3(message.target[0], message.target[1], message.target[2]);
  event.stiffness = message.stiffness;
  event.text = wire::text(message.text);
  return event;
}

}  // namespace flexcast::server
