// WorldWatch: which worlds live on a domain, from their statuses.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "idl/wire/fill.h"
#include "idl/wire/reader.h"

namespace flexcast::wire {

// One live world. Two servers that (wrongly) share a name show as two entries with different server_id.
struct World {
  std::shared_ptr<const flexcast_Status> status;  // the newest; shared: a snapshot outlives the next update
  Guid participant{};                             // of its server
  std::chrono::steady_clock::time_point heard;
};

inline std::string_view world_name(const World& world) {
  return text(world.status->world);
}

class WorldWatch {
 public:
  static Result<WorldWatch> create(const Participant& participant);

  // Takes what has arrived. Worlds whose server said goodbye, died (its lease ran out) or is silent for `silence`
  // leave.
  void update();

  // Updates until the news of worlds has ceased for a short while, at most for `most`: enough to know them all. With an
  // identity four times as long: it takes a third of a second to check one another's.
  void discover(std::chrono::nanoseconds most = std::chrono::seconds(1));

  // Updates until this world (any world, if "") is there; false on timeout.
  bool wait_for(std::string_view world, std::chrono::nanoseconds timeout);

  // Waits until there is news to update from; false on timeout.
  bool wait(std::chrono::nanoseconds timeout) const { return reader_.wait(timeout); }

  // Ordered by name. Pointers hold until the next non-const call.
  std::vector<const World*> worlds() const;
  const World* find(std::string_view world) const;  // null: not there

  static constexpr std::chrono::seconds silence{3};  // statuses come four times a second

 private:
  WorldWatch(Reader<flexcast_Status> reader, int slowness) : reader_(std::move(reader)), slowness_(slowness) {}

  Reader<flexcast_Status> reader_;
  int slowness_;                           // of matches, 1: of participants without identities
  std::map<std::uint64_t, World> worlds_;  // by writer
};

}  // namespace flexcast::wire
