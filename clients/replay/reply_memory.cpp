#include "clients/replay/reply_memory.h"

#include <algorithm>
#include <utility>

#include "idl/wire/fill.h"

namespace flexcast::replay {

ReplyMemory::Lookup ReplyMemory::begin(const std::string& client_id, std::uint64_t request_id) {
  if (!clients_.contains(client_id) && clients_.size() >= most_clients) make_room();
  Client& client = clients_[client_id];
  client.last_heard = ++requests_;
  const auto [request, is_new] = client.requests.try_emplace(request_id);
  if (is_new) return {Seen::first, nullptr};
  if (!request->second) return {Seen::in_flight, nullptr};
  return {Seen::answered, &**request->second};
}

const flexcast_Reply& ReplyMemory::store(wire::Owned<flexcast_Reply> reply) {
  Client& client = clients_[std::string(wire::text(reply->client_id))];
  const std::uint64_t request_id = reply->request_id;
  client.answered.push_back(request_id);
  if (client.answered.size() > most_replies) {
    client.requests.erase(client.answered.front());
    client.answered.pop_front();
  }
  return **(client.requests[request_id] = std::move(reply));
}

// A client with a request in flight stays: its answer is still to come.
void ReplyMemory::make_room() {
  auto oldest = clients_.end();
  for (auto client = clients_.begin(); client != clients_.end(); ++client) {
    const bool idle = client->second.requests.size() == client->second.answered.size();
    if (!idle) continue;
    if (oldest == clients_.end() || client->second.last_heard < oldest->second.last_heard) oldest = client;
  }
  if (oldest != clients_.end()) clients_.erase(oldest);
}

}  // namespace flexcast::replay
