// UnpublishedFrames: the numbers of a run's frames that were not published, as ranges. The publisher fills it frame by
// frame; a number that never comes is one that the mailbox had no room for.
#pragma once

#include <cstdint>
#include <vector>

#include "server/convert/status_types.h"

namespace flexcast::server {

class UnpublishedFrames {
 public:
  static constexpr std::size_t most_ranges = 64;  // the newest are kept

  // Frame `number` came to be published; those between the one before and it never come. Numbers grow until clear().
  void note(std::uint64_t number, bool published);

  // The frame noted last has been published after all.
  void note_newest_published();

  // Another run: its frames count from 0.
  void clear();

  const std::vector<FrameRange>& ranges() const { return ranges_; }  // in order

 private:
  void add(std::uint64_t first, std::uint64_t last);

  std::uint64_t next_ = 0;  // the number after the last noted one
  std::vector<FrameRange> ranges_;
};

}  // namespace flexcast::server
