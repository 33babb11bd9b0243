// A recording executed once more: every run from its scene and events, every frame compared by its state hash.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clients/recording/recording.h"
#include "clients/verify/run_report.h"

namespace flexcast::verify {

struct Report {
  std::string file;
  std::vector<RunReport> runs;        // in the order of their beginning
  std::vector<std::string> warnings;  // sentences: the file has no end, another version recorded it

  // Every run is equal (or empty), and there are frames.
  bool verified() const;
};

// How far it is.
struct Progress {
  std::uint64_t run = 0;  // from 1
  std::uint64_t runs = 0;
  std::int64_t step = 0;
  std::int64_t last_step = 0;  // of the recorded frames
};
using ShowProgress = std::function<bool(const Progress&)>;  // false ends the work

// `only`: one run, by its number from 1 on or by its run_id. Errors: what cannot be read, no run, no such run.
wire::Result<Report> verify_recording(recording::Recording& recording, std::optional<std::uint64_t> only,
                                      const ShowProgress& show);

}  // namespace flexcast::verify
