// A world's name is taken by one publisher of a domain: a server or a replay.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "idl/wire/participant.h"

namespace flexcast::replay {

// Listens for the world's name, then announces it and listens again: half a second in all. What runs keeps the name; of
// two that start at once the older one (the smaller id) does. The error names the world and the domain when this one
// has to yield. `announce` publishes a status with heartbeat 0.
wire::Result<void> claim_world(const wire::Participant& participant, const std::string& world, std::uint64_t own_id,
                               const std::function<void()>& announce);

}  // namespace flexcast::replay
