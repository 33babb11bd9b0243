// FrameRanges: a set of frame numbers, kept as ranges. Memory and time grow with the number of holes, not of frames.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace flexcast::record {

struct FrameRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;  // included

  bool operator==(const FrameRange&) const = default;
};

class FrameRanges {
 public:
  void add(std::uint64_t frame);
  void add(const FrameRange& range);
  void remove(std::uint64_t frame);

  bool contains(std::uint64_t frame) const { return stretch(frame).contained; }
  std::uint64_t size() const { return size_; }  // frames, not ranges
  bool empty() const { return ranges_.empty(); }
  std::uint64_t first() const { return ranges_.begin()->first; }   // of a set that is not empty
  std::uint64_t last() const { return ranges_.rbegin()->second; }  // the same

  std::vector<FrameRange> ranges() const;                          // ordered, neither overlapping nor adjacent
  std::vector<FrameRange> ranges_from(std::uint64_t frame) const;  // the same without what is before `frame`

  // Whether `frame` is in the set, and up to which number the answer stays the same.
  struct Stretch {
    bool contained = false;
    std::uint64_t last = 0;
  };
  Stretch stretch(std::uint64_t frame) const;

 private:
  std::map<std::uint64_t, std::uint64_t> ranges_;  // first -> last; neither overlapping nor adjacent
  std::uint64_t size_ = 0;
};

}  // namespace flexcast::record
