#include "server/world_claim.h"

#include <thread>

#include "idl/wire/fill.h"
#include "idl/wire/world_watch.h"
#include "server/convert/clock.h"

namespace flexcast::server {
namespace {

using namespace std::chrono_literals;

bool is_taken(const wire::WorldWatch& watch, const std::string& world, std::uint64_t own_id) {
  for (const wire::World* other : watch.worlds()) {
    if (wire::text(other->status->world) != world || other->status->server_id == own_id) continue;
    if (must_yield(own_id, {other->status->server_id, other->status->heartbeat})) return true;
  }
  return false;
}

}  // namespace

wire::Result<void> claim_world(const wire::Participant& participant, const std::string& world, std::uint64_t server_id,
                               const std::function<void()>& announce) {
  auto watch = wire::WorldWatch::create(participant);
  if (!watch) return watch.error();
  const auto half = participant.security().empty() ? 250ms : 1000ms;
  const auto begin = Clock::now();
  auto next_announcement = begin + half;
  while (Clock::now() < begin + 2 * half) {
    watch.value().update();
    if (is_taken(watch.value(), world, server_id)) {
      return wire::Error{"a server with world '" + world + "' runs on domain " + std::to_string(participant.domain()) +
                         " already; give this one another name with --world, or another domain with --domain"};
    }
    if (Clock::now() >= next_announcement) {
      announce();
      next_announcement += 100ms;
    }
    std::this_thread::sleep_for(10ms);
  }
  return {};
}

}  // namespace flexcast::server
