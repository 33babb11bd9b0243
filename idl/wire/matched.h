// The processes behind matched endpoints. Internal to idl/wire.
#pragma once

#include <dds/dds.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "idl/wire/entity.h"

namespace flexcast::wire {

// Frees what `endpoint` describes and returns its process.
inline std::optional<Guid> take_participant(dds_builtintopic_endpoint_t* endpoint) {
  if (!endpoint) return {};
  Guid guid{};
  std::copy(std::begin(endpoint->participant_key.v), std::end(endpoint->participant_key.v), guid.begin());
  dds_builtintopic_free_endpoint(endpoint);
  return guid;
}

// `list` and `describe`: dds_get_matched_{subscriptions, subscription_data} or dds_get_matched_{publications, ...}.
template <class List, class Describe>
std::vector<Guid> participants_of(EntityHandle self, List list, Describe describe) {
  std::vector<dds_instance_handle_t> peers(64);
  for (;;) {
    const dds_return_t count = list(self, peers.data(), peers.size());
    if (count < 0) return {};
    const bool all = static_cast<std::size_t>(count) <= peers.size();
    peers.resize(static_cast<std::size_t>(count));
    if (all) break;
  }
  std::vector<Guid> participants;
  for (const auto peer : peers)
    if (const auto guid = take_participant(describe(self, peer))) participants.push_back(*guid);
  return participants;
}

}  // namespace flexcast::wire
