// Which frames of a recording are exported.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/export/options.h"
#include "clients/recording/index.h"

namespace flexcast::exporting {

// First and last number of frames that are missing, by their numbers as recorded.
struct MissingFrames {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

struct Selection {
  std::size_t run = 0;  // of Index::runs(), from 0 on
  std::uint64_t run_id = 0;
  std::vector<std::size_t> frames;     // of Index::frames(), in their order; at least one
  std::vector<MissingFrames> missing;  // between the first and the last frame of these times, ordered
};

// An error if there is no such run, or no frame of it at these times.
wire::Result<Selection> select(const recording::Index& index, const Options& options);

// "run 2 of 2 (id 1763...: 120 frames, 0 s to 1.19 s); the others: run 1 (id ...)", for people.
std::string describe_run(const recording::Index& index, std::size_t run);

}  // namespace flexcast::exporting
