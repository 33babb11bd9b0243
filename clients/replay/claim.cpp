#include "clients/replay/claim.h"

#include <chrono>
#include <thread>

#include "idl/wire/world_watch.h"

namespace flexcast::replay {
namespace {

using namespace std::chrono_literals;

bool is_taken(const wire::WorldWatch& watch, const std::string& world, std::uint64_t own_id) {
  for (const wire::World* other : watch.worlds()) {
    const flexcast_Status& status = *other->status;
    if (wire::text(status.world) != world || status.server_id == own_id) continue;
    if (status.heartbeat > 0 || status.server_id < own_id) return true;
  }
  return false;
}

}  // namespace

wire::Result<void> claim_world(const wire::Participant& participant, const std::string& world, std::uint64_t own_id,
                               const std::function<void()>& announce) {
  auto watch = wire::WorldWatch::create(participant);
  if (!watch) return watch.error();
  constexpr int turns = 50;  // of 10 ms
  for (int turn = 0; turn < turns; ++turn) {
    watch.value().update();
    if (is_taken(watch.value(), world, own_id)) {
      return wire::Error{"world '" + world + "' is on domain " + std::to_string(participant.domain()) +
                         " already; give this replay another name with --as, or another domain with --domain"};
    }
    if (turn >= turns / 2 && turn % 10 == 5) announce();
    std::this_thread::sleep_for(10ms);
  }
  return {};
}

}  // namespace flexcast::replay
