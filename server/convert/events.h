// Events for the network, and from recordings of it.
#pragma once

#include <string_view>

#include "idl/wire/owned.h"
#include "server/convert/notice_types.h"

namespace flexcast::server {

wire::Owned<flexcast_Event> to_wire(const Event& event, std::string_view world);

// The error says what no server of this version writes.
Result<Event> from_wire(const flexcast_Event& message);

}  // namespace flexcast::server
