// FrameBatch: samples of frames that were taken together, put into the order of their frames. DDS keeps the order of
// the samples of each chunk number only, and gives one chunk number after the other.
#pragma once

#include <cstdint>
#include <vector>

#include "clients/record/item.h"
#include "idl/wire/frame_head.h"
#include "idl/wire/raw_reader.h"

namespace flexcast::record {

class FrameBatch {
 public:
  struct Arrival {
    wire::FrameHead head;      // without the world
    std::uint64_t writer = 0;  // as in wire::SampleInfo
    Message message;
  };

  void clear();

  // False if the sample has no sensible head: it is not taken then.
  bool add(const wire::RawSample& sample);

  // By run in the order in which they are met, the given one first, then by frame and chunk.
  void sort(std::uint64_t current_run);

  std::vector<Arrival>& arrivals() { return arrivals_; }
  std::size_t bytes() const { return bytes_; }

 private:
  std::vector<Arrival> arrivals_;
  std::size_t bytes_ = 0;
};

}  // namespace flexcast::record
