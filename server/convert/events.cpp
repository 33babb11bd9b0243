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

}  // namespace flexcast::server
