// Events for the network.
#pragma once

#include <string_view>

#include "idl/wire/owned.h"
#include "server/convert/notice_types.h"

namespace flexcast::server {

wire::Owned<flexcast_Event> to_wire(const Event& event, std::string_view world);

}  // namespace flexcast::server
