// Health: what a replay says of itself in its statuses: the recorded ones with their report, under its own state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clients/replay/restamp.h"
#include "idl/wire/owned.h"

namespace flexcast::replay {

// Of the frame that is shown, as published.
struct Shown {
  std::uint64_t run_id = 0;
  std::uint64_t frame = 0;
  std::uint64_t step = 0;
  double time = 0.0;  // s
  std::uint64_t parameter_revision = 0;
  std::uint64_t topology_revision = 0;
};

struct OwnState {
  flexcast_WorldState state = flexcast_WORLD_PAUSED;
  std::uint64_t heartbeat = 0;
  std::uint64_t server_id = 0;
  double rate = 1.0;
  std::uint64_t frames_published = 0;  // of this run
  std::uint32_t readers = 0;
};

class Health {
 public:
  // A status of the recording, which stays the newest until another comes or the replay jumps.
  void note(std::span<const std::byte> recorded) { recorded_.assign(recorded.begin(), recorded.end()); }
  void forget() { recorded_.clear(); }

  // The newest recorded status as it is to be published: with its own report where `as_it_came`, or where that tells of
  // the step that is shown; else step and time are those of the shown frame, and NaN says that the rest is not known.
  wire::Owned<flexcast_Status> make(const Shown& shown, const OwnState& own, const Stamp& stamp, bool as_it_came) const;

 private:
  std::vector<std::byte> recorded_;  // empty: none
};

}  // namespace flexcast::replay
