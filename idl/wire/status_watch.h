// StatusWatch: the statuses of all worlds of a domain as they come, and how they end.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "idl/wire/reader.h"

namespace flexcast::wire {

// One thing that became known.
struct StatusNews {
  enum class Kind {
    status,    // a status came
    goodbye,   // its server ended on purpose
    vanished,  // its server is dead or unreachable: no sign of life within the lease
  };
  Kind kind = Kind::status;
  std::string world;
  std::shared_ptr<const flexcast_Status> status;  // null unless it is one; shared: it outlives the watch
  Guid participant{};                             // of its server; zero unless it is a status
  std::int64_t written = 0;                       // ns since 1970, by the server's clock
  std::chrono::steady_clock::time_point heard;
};

class StatusWatch {
 public:
  static Result<StatusWatch> create(const Participant& participant);

  // Waits until there is news; false on timeout.
  bool wait(std::chrono::nanoseconds timeout) const { return reader_.wait(timeout); }

  // In the order of arrival. Of statuses that came since the last call the newest of each server, at least.
  std::vector<StatusNews> take();

  // The processes that write statuses this program can read.
  std::vector<Guid> servers() const { return reader_.matched_participants(); }

 private:
  explicit StatusWatch(Reader<flexcast_Status> reader) : reader_(std::move(reader)) {}
  Reader<flexcast_Status> reader_;
  std::map<std::uint64_t, std::string> worlds_;  // by instance
};

}  // namespace flexcast::wire
