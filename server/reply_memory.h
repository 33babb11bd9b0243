// ReplyMemory: what each client asked and was answered lately, so that a repeated request is answered from memory and
// never executed twice. May be used from several threads.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "server/convert/command_types.h"

namespace flexcast::server {

class ReplyMemory {
 public:
  struct Limits {
    std::size_t replies = 256;   // of each client: older ones are forgotten
    std::size_t clients = 1024;  // those longest silent are forgotten, unless a request of theirs is in flight
  };

  enum class Seen { first, in_flight, answered };
  struct Lookup {
    Seen seen = Seen::first;
    std::optional<Reply> reply;  // Seen::answered
  };

  ReplyMemory() : ReplyMemory(Limits{}) {}
  explicit ReplyMemory(const Limits& limits) : limits_(limits) {}

  // Looks a request up; one not seen before is in flight from now on, and the caller executes it.
  Lookup begin(const RequestKey& key);
  // The caller could not execute it after all: as if it had never come.
  void forget(const RequestKey& key);
  // The answer to a request in flight.
  void store(const Reply& reply);

 private:
  struct Client {
    std::unordered_map<std::uint64_t, std::optional<Reply>> requests;  // empty: in flight
    std::deque<std::uint64_t> answered;                                // the oldest first
    std::uint64_t last_heard = 0;
  };
  void make_room();

  Limits limits_;
  std::mutex mutex_;
  std::unordered_map<std::string, Client> clients_;
  std::uint64_t requests_ = 0;  // counts, to tell who was heard last
};

}  // namespace flexcast::server
