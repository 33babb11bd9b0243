// Recovery: completes what a recorder that was killed has left.
#pragma once

#include <cstdint>
#include <string>

#include "clients/mcap/byte_sink.h"
#include "clients/record/report.h"
#include "idl/wire/result.h"

namespace flexcast::record {

struct Recovery {
  bool was_complete = false;    // nothing was done; only report.file is known
  Report report;                // as if the recorder had ended with the last whole chunk
  std::uint64_t cut_bytes = 0;  // of the file: what is after that
};

// Writes everything up to the last whole chunk of `file`, the beginning of a recording, to `sink` and completes it.
mcap::Result<Recovery> recover(mcap::Bytes file, mcap::ByteSink& sink);

// The same on the disk: the new file is written beside the old one and takes its place when it is complete. A complete
// file is left alone; a file that has its end but is damaged is an error and left alone, too.
wire::Result<Recovery> recover(const std::string& path);

// For people, with the summary of the recording, and for programs: the report's object with cut_bytes and complete.
std::string to_text(const Recovery& recovery);
std::string to_json(const Recovery& recovery);

}  // namespace flexcast::record
