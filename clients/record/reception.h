// What a recording has received, while it runs and when it has ended.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "clients/record/run_ledger.h"
#include "idl/wire/topics.h"

namespace flexcast::record {

struct Progress {
  std::uint64_t run_id = 0;          // of the newest frame
  std::uint64_t next_frame = 0;      // that is expected in this run
  std::uint64_t contiguous_end = 0;  // every frame of this run before it is in hand or known not to come
  std::uint64_t frames = 0;          // complete ones
  std::uint64_t missing = 0;         // frames
  std::uint64_t dropped = 0;         // messages that did not fit the queue
};

// `recovered`: completed afterwards.
enum class EndReason { stopped, frames, duration, failed, recovered };

struct Reception {
  EndReason end = EndReason::stopped;
  std::vector<RunSummary> runs;
  std::vector<Gap> gaps;
  std::vector<Pause> pauses;
  std::map<wire::TopicId, std::uint64_t> dropped;  // messages
  std::uint64_t unreadable = 0;                    // messages without a sensible head
  double seconds = 0;                              // from the first frame to the end
  std::string server_version;
  std::string error;  // EndReason::failed: why nothing more can be taken; "" if it was the file
};

}  // namespace flexcast::record
