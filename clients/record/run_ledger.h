// RunLedger: which frames of one run are in the recording, and which are missing.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "clients/record/frame_ranges.h"
#include "idl/wire/frame_head.h"

namespace flexcast::record {

// Why a frame is missing.
enum class GapCause {
  unpublished,  // the server says that it did not publish it
  lost,         // it was lost on the way, as far as is known
  incomplete,   // some of its chunks came, others did not
  queue,        // it came while the recorder's queue was full: the disk was too slow
  disk,         // it came, but the file could not take it
};

// "unpublished", "lost", "incomplete", "queue", "disk"
std::string_view name_of(GapCause cause);

struct Gap {
  std::uint64_t run_id = 0;
  std::uint64_t first = 0;
  std::uint64_t last = 0;  // included
  GapCause cause = GapCause::lost;

  bool operator==(const Gap&) const = default;
};

// Frames of one run that were published while the recorder was paused: not recorded, and not missing.
struct Pause {
  std::uint64_t run_id = 0;
  std::uint64_t first = 0;
  std::uint64_t last = 0;  // included

  bool operator==(const Pause&) const = default;
};

struct RunSummary {
  std::uint64_t run_id = 0;
  std::uint64_t joined_at = 0;    // the first frame that should be in the recording; 0: watched from the beginning
  std::uint64_t first_frame = 0;  // in the recording, if frames > 0
  std::uint64_t last_frame = 0;
  std::uint64_t frames = 0;  // complete ones
  std::uint64_t steps = 0;   // from the first to the last frame
  double seconds = 0;        // the same, simulated
};

// Chunks of several frames may come mixed up, those with the same chunk number come in the order of their frames. Every
// head given here has chunk < chunks.
class RunLedger {
 public:
  // `watched`: the recorder was there when the run began, so frame 0 should come. Otherwise it joins with the first
  // frame it sees whole.
  RunLedger(std::uint64_t run_id, bool watched, std::uint64_t first_seen)
      : run_id_(run_id), watched_(watched), first_seen_(first_seen), newest_(first_seen) {}

  std::uint64_t run_id() const { return run_id_; }

  // A chunk that is not newer than the last one recorded with its number: sent again for late joiners.
  bool is_repeated(const wire::FrameHead& head) const;

  // A frame of which nothing was recorded so far.
  bool is_new(std::uint64_t frame) const { return !seen_.contains(frame); }

  // Takes note of a recorded chunk; true when it makes its frame complete.
  bool add(const wire::FrameHead& head);

  // Takes note of a chunk that did not fit the queue.
  void drop(const wire::FrameHead& head);

  // Takes note of a chunk that is not wanted: older frames can no longer get a chunk of that number.
  void pass(const wire::FrameHead& head);

  // Takes note of a chunk that came while the recorder was paused. What is lost between two of these counts as paused.
  void skip(const wire::FrameHead& head);
  void resume() { skipping_.reset(); }
  bool is_skipped(std::uint64_t frame) const { return paused_.contains(frame); }

  // The server says that it did not publish these.
  void note_unpublished(const FrameRange& range) { unpublished_.add(range); }

  // What another ledger of this run has said (see AccountNote): frames that came while the recorder was paused, frames
  // that did not fit its queue, that it was there when the run began.
  void note_paused(const FrameRange& range) { note_known(range, paused_); }
  void note_dropped(const FrameRange& range) { note_known(range, dropped_); }
  void note_watched() { watched_ = true; }

  // What it would say of frames from `first` on.
  std::vector<FrameRange> paused_from(std::uint64_t first) const { return paused_.ranges_from(first); }
  std::vector<FrameRange> dropped_from(std::uint64_t first) const { return dropped_.ranges_from(first); }
  bool is_watched() const { return watched_; }

  // Takes back a recorded chunk: the file could not take it. True if its frame was complete.
  bool lose(const wire::FrameHead& head);

  std::uint64_t frames() const { return complete_.size(); }
  std::uint64_t in_progress() const;  // frames that are newer than every complete one and may become complete
  std::uint64_t missing() const;      // frames, without those in progress
  std::uint64_t next_frame() const { return complete_.empty() ? joined_at() : complete_.last() + 1; }

  // The first frame from where the run was joined that is neither there nor known not to come, nor given up.
  std::uint64_t contiguous_end() const;
  // Whether newer frames are there than one that is not: that one comes no more, and why may still be told.
  bool has_hole() const { return !complete_.empty() && contiguous_end() < complete_.last(); }
  // Nobody will tell: what is not there of frames before the newest is not waited for. It stays missing.
  void give_up_holes() { given_up_.add({contiguous_end(), complete_.last()}); }

  RunSummary summary() const;

  // Ordered; neighbours differ in cause. Frames in progress count as incomplete.
  std::vector<Gap> gaps() const;
  std::vector<Pause> pauses() const;

 private:
  struct Moment {
    std::uint64_t step = 0;
    double time = 0;
  };
  std::uint64_t joined_at() const;
  bool may_become_complete(std::uint64_t frame, const std::vector<bool>& part) const;
  GapCause cause_of(std::uint64_t frame) const;
  void note_known(const FrameRange& range, FrameRanges& ranges);

  std::uint64_t run_id_;
  bool watched_;
  std::uint64_t first_seen_;
  std::uint64_t newest_;  // dropped ones included
  Moment first_;          // of complete frames
  Moment last_;
  FrameRanges complete_;
  FrameRanges seen_;                                  // a chunk was recorded
  FrameRanges dropped_;                               // a chunk was not
  FrameRanges paused_;                                // the recorder was paused
  FrameRanges unpublished_;                           // says the server
  FrameRanges given_up_;                              // not there, or there by now
  FrameRanges cut_;                                   // the file could not take a chunk
  std::optional<std::uint64_t> skipping_;             // the newest frame of the pause that lasts
  std::map<std::uint64_t, std::vector<bool>> parts_;  // which chunks came, of frames that are not complete
  std::vector<std::uint64_t> next_;                   // of each chunk number: 1 + the last frame recorded or passed
};

}  // namespace flexcast::record
