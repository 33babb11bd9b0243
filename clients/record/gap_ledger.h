// GapLedger: decides which frames are recorded and knows at any time which are missing. Frame numbers are contiguous
// from 0 within every run, so what is not there shows.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "clients/record/account_note.h"
#include "clients/record/run_ledger.h"

namespace flexcast::record {

enum class Verdict {
  record,    // then tell add() or drop()
  repeated,  // not newer than what there is: the server sends the newest frame again for late joiners
  beyond,    // a new frame, but there are enough: then tell pass()
  paused,    // the recorder is paused, or was when the frame began: then tell skip()
  invalid,   // chunk numbers that make no sense
};

class GapLedger {
 public:
  static constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

  // Takes `most_frames` complete frames.
  explicit GapLedger(std::uint64_t most_frames = no_limit) : most_frames_(most_frames) {}

  // No new frames from now on; those in progress may become complete.
  void close() { closed_ = true; }

  // While paused no new frames are recorded; those in progress may become complete.
  void pause() { paused_ = true; }
  void resume();
  bool is_paused() const { return paused_; }

  Verdict judge(const wire::FrameHead& head) const;

  // `writer`: who sent it, as in wire::SampleInfo. Of a run of a writer that has sent frames before, frame 0 should
  // come; of the first run of another one (the recorder or the server has just come) it need not.
  void add(const wire::FrameHead& head, std::uint64_t writer);
  void drop(const wire::FrameHead& head, std::uint64_t writer);
  void skip(const wire::FrameHead& head, std::uint64_t writer);

  void pass(const wire::FrameHead& head);

  // What a status says: `ranges` are first, last, first, last, ... of frames that the server did not publish.
  void note_unpublished(std::uint64_t run_id, std::span<const std::uint64_t> ranges);

  // What has been dropped and skipped, and which runs were seen from their beginning, since the last call. (`messages`
  // are not known here.)
  AccountNote take_news();
  // The same, told by the ledger of another recorder of this file: then drop() and skip() are not called here.
  void note(const AccountNote& account);

  // Takes back a chunk given to add(): the file could not take it.
  void lose(const wire::FrameHead& head);

  bool is_full() const { return frames_ >= most_frames_; }
  std::uint64_t frames() const { return frames_; }  // complete ones
  std::uint64_t missing() const;                    // without those in progress
  std::uint64_t in_progress() const { return runs_.empty() ? 0 : runs_[current_].in_progress(); }

  bool has_lost() const;  // frames that are missing, nobody knows why

  // Of the run that frames came from last; 0 before the first.
  std::uint64_t run_id() const { return runs_.empty() ? 0 : runs_[current_].run_id(); }
  std::uint64_t next_frame() const { return runs_.empty() ? 0 : runs_[current_].next_frame(); }

  // Of the same run, see RunLedger.
  bool has_hole() const { return !runs_.empty() && runs_[current_].has_hole(); }
  void give_up_holes() { runs_[current_].give_up_holes(); }
  std::uint64_t contiguous_end() const { return runs_.empty() ? 0 : runs_[current_].contiguous_end(); }

  // In the order in which they were met.
  std::vector<RunSummary> runs() const;
  std::vector<Gap> gaps() const;
  std::vector<Pause> pauses() const;

 private:
  // Frames of one run that take_news() has to tell of.
  struct News {
    std::uint64_t first = 0;
    std::uint64_t newest = 0;  // told or not
    bool fresh = true;
  };
  const RunLedger* find(std::uint64_t run_id) const;
  RunLedger* find(std::uint64_t run_id) { return const_cast<RunLedger*>(std::as_const(*this).find(run_id)); }
  RunLedger& open(const wire::FrameHead& head, std::uint64_t writer);
  RunLedger& open(std::uint64_t run_id, std::uint64_t first_frame);
  RunLedger& begin(std::uint64_t run_id, bool watched, std::uint64_t first_frame);
  void note_news(const wire::FrameHead& head);

  std::uint64_t most_frames_;
  bool closed_ = false;
  bool paused_ = false;
  std::uint64_t frames_ = 0;
  std::deque<RunLedger> runs_;
  std::size_t current_ = 0;  // in runs_
  std::set<std::uint64_t> writers_;
  std::map<std::uint64_t, News> news_;                      // by run
  std::vector<std::uint64_t> news_of_watched_;              // runs
  std::set<std::uint64_t> watched_;                         // runs that another ledger has watched
  std::map<std::uint64_t, std::vector<FrameRange>> early_;  // unpublished frames of runs that no frame came from yet
};

}  // namespace flexcast::record
