// ReplyMemory: what each client asked and was answered lately, so that a repeated request is answered from memory and
// never executed twice.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "idl/wire/owned.h"
#include "idl/wire/types.h"

namespace flexcast::replay {

class ReplyMemory {
 public:
  static constexpr std::size_t most_replies = 256;   // of each client: older ones are forgotten
  static constexpr std::size_t most_clients = 1024;  // those longest silent are forgotten

  enum class Seen { first, in_flight, answered };
  struct Lookup {
    Seen seen = Seen::first;
    const flexcast_Reply* reply = nullptr;  // Seen::answered; valid until the next call
  };

  // Looks a request up; one not seen before is in flight from now on, and the caller executes it.
  Lookup begin(const std::string& client_id, std::uint64_t request_id);

  // The answer to a request in flight. The reference is valid until the next call.
  const flexcast_Reply& store(wire::Owned<flexcast_Reply> reply);

 private:
  struct Client {
    std::map<std::uint64_t, std::optional<wire::Owned<flexcast_Reply>>> requests;  // empty: in flight
    std::deque<std::uint64_t> answered;                                            // the oldest first
    std::uint64_t last_heard = 0;
  };
  void make_room();

  std::map<std::string, Client> clients_;
  std::uint64_t requests_ = 0;  // counts, to tell who was heard last
};

}  // namespace flexcast::replay
