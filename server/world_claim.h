// A world's name is taken by one server of a domain.
#pragma once

#include <functional>
#include <optional>

#include "idl/wire/participant.h"

namespace flexcast::server {

// What another server's status says.
struct Rival {
  std::uint64_t server_id = 0;  // grows with the time of its start
  std::uint64_t heartbeat = 0;  // 0: it has not begun to run
};

// A server that runs keeps the name; of two that start at once the older one (the smaller id).
inline bool must_yield(std::uint64_t own_id, const Rival& rival) {
  return rival.heartbeat > 0 || rival.server_id < own_id;
}

// Listens for the world's name, then announces it and listens again: half a second in all, two seconds with an
// identity, for it takes a third of a second until two servers have checked one another's. The error names the world
// and the domain when this server has to yield. `announce` publishes a status of this server.
wire::Result<void> claim_world(const wire::Participant& participant, const std::string& world, std::uint64_t server_id,
                               const std::function<void()>& announce);

}  // namespace flexcast::server
