// What a recording holds of each run: its scene, its events and the numbers of its frames.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/recording/recording.h"
#include "idl/wire/owned.h"
#include "server/convert/notice_types.h"

namespace flexcast::verify {

// One frame, or one chunk of one that does not say the same as the others.
struct RecordedFrame {
  std::uint64_t frame = 0;  // within the run
  std::int64_t step = 0;
  double time = 0.0;  // s
  std::uint64_t state_hash = 0;

  friend bool operator==(const RecordedFrame&, const RecordedFrame&) = default;
};

struct RecordedRun {
  std::uint64_t run_id = 0;
  std::string world;
  std::optional<wire::Owned<flexcast_SceneInfo>> scene = {};
  std::map<std::uint64_t, server::Event> events = {};  // by index
  std::vector<RecordedFrame> frames = {};              // ordered by number; a number twice where samples differ
};

// The runs in the order of their beginning. The error names the file and the message that cannot be read.
wire::Result<std::vector<RecordedRun>> read_runs(recording::Recording& recording);

// "" when the events are numbered 0, 1, 2, ... without a gap; else a sentence that names the first missing one.
std::string describe_missing_event(const RecordedRun& run);

// First and last number of each range of frames that is missing between frame 0 and the newest one.
std::vector<std::pair<std::uint64_t, std::uint64_t>> find_gaps(const RecordedRun& run);

}  // namespace flexcast::verify
