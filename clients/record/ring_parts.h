// RingParts: the folder RUN.mcap.parts of a recording of which only the newest seconds of frames and statuses are kept:
// base.mcap holds everything else, ring-000000.mcap, ring-000001.mcap, ... a short time of frames and statuses each.
// None of these files has its end: they are put together when the recording ends, or recovered.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "clients/record/content_ledger.h"
#include "clients/record/report.h"
#include "idl/wire/result.h"

namespace flexcast::record {

std::string ring_folder(const std::string& path);                      // of RUN.mcap
std::string ring_base(const std::string& path);                        // its file
std::string ring_part(const std::string& path, std::uint64_t number);  // the same
inline constexpr const char* ring_metadata = "flexcast.ring";          // in the base: `seconds`

bool has_ring(const std::string& path);
void remove_ring(const std::string& path);

// What has been put together, and how to end it.
using EndReport = std::function<Report(const ContentLedger&)>;

// Writes the recording to RUN.mcap: everything of the base, and of the parts the frames and statuses of the last
// seconds by log time (the base says how many). A frame is kept when all of its chunks are that new. `make_report`
// gives the report for the metadata from what is kept.
wire::Result<Report> join_ring(const std::string& path, const EndReport& make_report);

}  // namespace flexcast::record
