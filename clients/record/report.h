// Report: what was recorded and what is missing, for people, for programs and for the file itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/mcap/types.h"
#include "clients/record/reception.h"

namespace flexcast::record {

struct Report {
  std::string file;
  std::string world;
  int domain = 0;  // below 0: not known, as is the profile then
  std::string profile;
  Reception reception;
  std::uint64_t messages = 0;        // in the file
  std::uint64_t bytes = 0;           // of the file
  std::vector<std::string> parts{};  // the files, if there is more than one
  std::string failure{};             // why the recording ended early and what is after it is missing; "" if it did not
};

std::uint64_t frame_count(const Report& report);    // complete ones
std::uint64_t missing_count(const Report& report);  // frames
std::uint64_t paused_count(const Report& report);   // frames published while the recorder was paused
std::uint64_t dropped_count(const Report& report);  // messages
std::uint64_t step_count(const Report& report);
double simulated_seconds(const Report& report);

// Several lines: what there is, then one line for each run that was joined late and for each gap (a hundred at most).
std::string to_text(const Report& report);

// One object: file, world, frames, gaps (missing frames), missing [{run_id, first, last, cause}], causes {cause:
// frames}, paused [{run_id, first, last}], paused_frames, runs [{run_id, first_frame, last_frame, frames, joined_at}],
// bytes, seconds, messages, dropped, simulated_seconds, steps; parts [file] if there are several, failure if there was
// one.
std::string to_json(const Report& report);

// Metadata record flexcast.gaps: `missing` (frames), `gaps`, for each gap `gap.N` = "RUN_ID FIRST LAST CAUSE", `paused`
// (frames), and for each range of them `pause.N` = "RUN_ID FIRST LAST".
mcap::TextPairs gaps_metadata(const Report& report);

// Metadata record flexcast.recording: world, domain, profile, version (of the recorder), server_version, ended, frames,
// dropped (messages), dropped.TOPIC, unreadable, seconds, runs, and for each run `run.N` = "RUN_ID FIRST_FRAME
// LAST_FRAME FRAMES JOINED_AT".
mcap::TextPairs recording_metadata(const Report& report);

}  // namespace flexcast::record
