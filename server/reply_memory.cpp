#include "server/reply_memory.h"

namespace flexcast::server {

ReplyMemory::Lookup ReplyMemory::begin(const RequestKey& key) {
  const std::scoped_lock lock(mutex_);
  if (!clients_.contains(key.client_id) && clients_.size() >= limits_.clients) make_room();
  Client& client = clients_[key.client_id];
  client.last_heard = ++requests_;
  const auto [request, is_new] = client.requests.try_emplace(key.request_id);
  if (is_new) return {Seen::first, {}};
  if (!request->second) return {Seen::in_flight, {}};
  return {Seen::answered, request->second};
}

void ReplyMemory::forget(const RequestKey& key) {
  const std::scoped_lock lock(mutex_);
  const auto client = clients_.find(key.client_id);
  if (client != clients_.end()) client->second.requests.erase(key.request_id);
}

void ReplyMemory::store(const Reply& reply) {
  const std::scoped_lock lock(mutex_);
  const auto found = clients_.find(reply.key.client_id);
  if (found == clients_.end()) return;
  Client& client = found->second;
  client.requests[reply.key.request_id] = reply;
  client.answered.push_back(reply.key.request_id);
  if (client.answered.size() <= limits_.replies) return;
  client.requests.erase(client.answered.front());
  client.answered.pop_front();
}

void ReplyMemory::make_room() {
  const auto idle = [](const Client& client) { return client.requests.size() == client.answered.size(); };
  auto oldest = clients_.end();
  for (auto client = clients_.begin(); client != clients_.end(); ++client) {
    if (!idle(client->second)) continue;
    if (oldest == clients_.end() || client->second.last_heard < oldest->second.last_heard) oldest = client;
  }
  if (oldest != clients_.end()) clients_.erase(oldest);
}

}  // namespace flexcast::server
