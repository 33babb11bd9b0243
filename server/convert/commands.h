// Commands from the network, replies to it.
#pragma once

#include <string_view>

#include "idl/wire/owned.h"
#include "server/convert/command_types.h"

namespace flexcast::server {

// A command that makes no sense becomes a MalformedCommand. `received`: when it came, expires_in counts from there.
Command from_wire(const flexcast_Command& message, Clock::time_point received);

wire::Owned<flexcast_Reply> to_wire(const Reply& reply, std::string_view world);

}  // namespace flexcast::server
