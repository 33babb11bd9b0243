// GapLedger: decides which frames are recorded and knows at any time which are missing. Frame numbers are contiguous
// from 0 within every run, so what is not there shows.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <set>
#include <vector>

#include "clients/record/run_ledger.h"

namespace flexcast::record {

enum class Verdict {
  record,    // then tell add() or drop()
  repeated,  // not newer than what there is: the server sends the newest frame again for late joiners
  beyond,    // a new frame, but there are enough
  invalid,   // chunk numbers that make no sense
};

class GapLedger {
 public:
  static constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

  // Takes `most_frames` complete frames.
  explicit GapLedger(std::uint64_t most_frames = no_limit) : most_frames_(most_frames) {}

  // No new frames from now on; those in progress may become complete.
  void close() { closed_ = true; }

  Verdict judge(const wire::FrameHead& head) const;

  // `writer`: who sent it, as in wire::SampleInfo. Of a run of a writer that has sent frames before, frame 0 should
  // come; of the first run of another one (the recorder or the server has just come) it need not.
  void add(const wire::FrameHead& head, std::uint64_t writer);
  void drop(const wire::FrameHead& head, std::uint64_t writer);

  bool is_full() const { return frames_ >= most_frames_; }
  std::uint64_t frames() const { return frames_; }  // complete ones
  std::uint64_t missing() const;                    // without those in progress
  std::uint64_t in_progress() const { return runs_.empty() ? 0 : runs_[current_].in_progress(); }

  // Of the run that frames came from last; 0 before the first.
  std::uint64_t run_id() const { return runs_.empty() ? 0 : runs_[current_].run_id(); }
  std::uint64_t next_frame() const { return runs_.empty() ? 0 : runs_[current_].next_frame(); }

  // In the order in which they were met.
  std::vector<RunSummary> runs() const;
  std::vector<Gap> gaps() const;

 private:
  const RunLedger* find(std::uint64_t run_id) const;
  RunLedger& open(const wire::FrameHead& head, std::uint64_t writer);

  std::uint64_t most_frames_;
  bool closed_ = false;
  std::uint64_t frames_ = 0;
  std::deque<RunLedger> runs_;
  std::size_t current_ = 0;  // in runs_
  std::set<std::uint64_t> writers_;
};

}  // namespace flexcast::record
