#include "clients/web/router.h"

#include <algorithm>
#include <vector>

#include "idl/wire/fill.h"
#include "idl/wire/names.h"

namespace flexcast::web {

void Router::send(const std::string& world, const client::Request& request, const void* owner, Clock::time_point now,
                  Answer answer) {
  if (count(owner) >= most_of_an_owner)
    return answer(wire::Error{"there are " + std::to_string(most_of_an_owner) + " calls under way already"});
  const bool takes_its_time = request.kind == flexcast_COMMAND_STEP || request.kind == flexcast_COMMAND_RUN_UNTIL;
  Pending pending{.world = world,
                  .owner = owner,
                  .command = {},
                  .answer = std::move(answer),
                  .takes_its_time = takes_its_time,
                  .next_sending = now,
                  .deadline = now + patience};
  const std::uint64_t id = ++last_request_;
  client::to_wire(*pending.command, request);
  wire::set_string(pending.command->world, world);
  wire::set_string(pending.command->client_id, port_.client_id());
  pending.command->request_id = id;
  pending.command->expires_in = takes_its_time ? 0.0 : std::chrono::duration<double>(patience).count();
  try_to_send(pending_.emplace(id, std::move(pending)).first->second, now);
}

std::size_t Router::count(const void* owner) const {
  return static_cast<std::size_t>(
      std::count_if(pending_.begin(), pending_.end(), [&](const auto& entry) { return entry.second.owner == owner; }));
}

// The server's match may be milliseconds away still, or the server between two lives: then again at the next tick.
void Router::try_to_send(Pending& pending, Clock::time_point now) {
  const auto server = find_server_(pending.world);
  if (!server || !port_.reaches(*server) || !port_.write(*pending.command)) return;
  pending.sent = true;
  pending.next_sending = now + resend_period;
}

void Router::receive(const std::string& world, std::uint64_t request_id, const client::Reply& reply) {
  const auto pending = pending_.find(request_id);
  if (pending != pending_.end() && pending->second.world == world) answer(pending, reply);
}

void Router::answer(std::map<std::uint64_t, Pending>::iterator pending, const wire::Result<client::Reply>& result) {
  const Answer answer = std::move(pending->second.answer);
  pending_.erase(pending);  // first: the answer may lead to another command
  answer(result);
}

void Router::tick(Clock::time_point now) {
  answer_where([&](const Pending& pending) { return now >= pending.deadline; },
               [](const Pending& pending) {
                 const std::string verb(wire::name_of(pending.command->kind));
                 return pending.sent ? "no answer from world '" + pending.world + "' to " + verb + " within 10 s"
                                     : "world '" + pending.world + "' was not there for 10 s to take " + verb;
               });
  for (auto& [id, pending] : pending_)
    if (now >= pending.next_sending) try_to_send(pending, now);
}

void Router::note_life(const std::string& world, Clock::time_point now) {
  for (auto& [id, pending] : pending_)
    if (pending.takes_its_time && pending.world == world) pending.deadline = now + patience;
}

void Router::lose(const std::string& world, const std::string& why) {
  answer_where([&](const Pending& pending) { return pending.world == world; }, [&](const Pending&) { return why; });
}

void Router::answer_where(const std::function<bool(const Pending&)>& condition,
                          const std::function<std::string(const Pending&)>& why) {
  std::vector<std::uint64_t> ids;
  for (const auto& [id, pending] : pending_)
    if (condition(pending)) ids.push_back(id);
  for (const std::uint64_t id : ids) {
    const auto pending = pending_.find(id);
    if (pending != pending_.end()) answer(pending, wire::Error{why(pending->second)});
  }
}

void Router::forget(const void* owner) {
  std::erase_if(pending_, [&](const auto& entry) { return entry.second.owner == owner; });
}

}  // namespace flexcast::web
