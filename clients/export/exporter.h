// The export itself: the selected frames of a recording to a VTK series or to a table.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "clients/export/options.h"
#include "clients/export/selection.h"

namespace flexcast::exporting {

// What was written.
struct Summary {
  std::uint64_t frames = 0;
  std::uint64_t files = 0;
  std::uint64_t bytes = 0;
  std::string output;                     // run.pvd, or the table
  std::vector<std::string> fields;        // beside the positions
  std::vector<std::uint64_t> incomplete;  // numbers of selected frames that lack a chunk, and are left out
};

// Called before each frame with how many are done.
using ExportProgress = std::function<void(std::uint64_t)>;

// Nothing is written when a file is there that may not be replaced, or when a field that was asked for is not streamed.
wire::Result<Summary> export_frames(recording::Recording& recording, const recording::Index& index,
                                    const Selection& selection, const Options& options, const ExportProgress& progress);

}  // namespace flexcast::exporting
