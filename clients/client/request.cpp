#include "clients/client/request.h"

#include <algorithm>

#include "idl/wire/fill.h"

namespace flexcast::client {

void to_wire(flexcast_Command& command, const Request& request) {
  command.kind = request.kind;
  command.check_revision = request.expected_revision.has_value();
  command.expected_revision = request.expected_revision.value_or(0);
  const bool named = request.kind == flexcast_COMMAND_GET;
  auto values = wire::resize(command.values, named ? request.names.size() : request.values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (named)
      wire::set_string(values[i].name, request.names[i]);
    else
      to_wire(values[i], request.values[i]);
  }
  command.keep_parameters = request.keep_parameters;
  command.count = request.count;
  command.time = request.time;
  wire::set_string(command.name, request.name);
  command.particle = request.particle;
  std::copy(request.target.begin(), request.target.end(), command.target);
  command.stiffness = request.stiffness;
}

}  // namespace flexcast::client
