// FrameGrouper: puts the chunks of ONE world's frames together.
#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "clients/web/sample.h"
#include "idl/wire/frame_head.h"

namespace flexcast::web {

class FrameGrouper {
 public:
  // Takes a chunk; returns the frame it completes. Frames that are not newer than the last one of their run are left
  // out, and so are chunks that contradict themselves.
  std::optional<WholeFrame> add(const wire::FrameHead& head, Sample chunk);

  static constexpr std::size_t most_partials = 4;
  static constexpr std::uint32_t most_chunks = 4096;

 private:
  struct Partial {
    WholeFrame frame;
    std::uint32_t missing = 0;
  };
  Partial& find_or_begin(const wire::FrameHead& head);
  WholeFrame finish(const Partial& partial);

  std::deque<Partial> partials_;                                 // the oldest first
  std::optional<std::pair<std::uint64_t, std::uint64_t>> last_;  // run, frame
};

}  // namespace flexcast::web
