#include "clients/record/run_ledger.h"

#include <algorithm>

namespace flexcast::record {
namespace {

// Chunks are mixed up over as many frames as wait in the reader at most; what is older stays incomplete.
constexpr std::size_t most_parts = 4096;

}  // namespace

std::string_view name_of(GapCause cause) {
  switch (cause) {
    case GapCause::unpublished:
      return "unpublished";
    case GapCause::lost:
      return "lost";
    case GapCause::incomplete:
      return "incomplete";
    case GapCause::queue:
      return "queue";
    case GapCause::disk:
      return "disk";
  }
  return "unknown";
}

bool RunLedger::is_repeated(const wire::FrameHead& head) const {
  return head.chunk < next_.size() && head.frame < next_[head.chunk];
}

bool RunLedger::add(const wire::FrameHead& head) {
  newest_ = std::max(newest_, head.frame);
  first_seen_ = std::min(first_seen_, head.frame);
  seen_.add(head.frame);
  if (next_.size() < head.chunks) next_.resize(head.chunks, 0);
  next_[head.chunk] = head.frame + 1;

  std::vector<bool>& part = parts_[head.frame];
  if (part.empty()) part.resize(head.chunks);
  if (part.size() == head.chunks) part[head.chunk] = true;
  if (std::find(part.begin(), part.end(), false) != part.end()) {
    if (parts_.size() > most_parts) parts_.erase(parts_.begin());
    return false;
  }
  parts_.erase(head.frame);
  const Moment moment{head.step, head.time};
  if (complete_.empty() || head.frame < complete_.first()) first_ = moment;
  if (complete_.empty() || head.frame > complete_.last()) last_ = moment;
  complete_.add(head.frame);
  return true;
}

void RunLedger::drop(const wire::FrameHead& head) {
  newest_ = std::max(newest_, head.frame);
  dropped_.add(head.frame);
}

void RunLedger::pass(const wire::FrameHead& head) {
  if (head.chunk < next_.size()) next_[head.chunk] = std::max(next_[head.chunk], head.frame + 1);
}

void RunLedger::skip(const wire::FrameHead& head) {
  newest_ = std::max(newest_, head.frame);
  // Chunks of several frames may come mixed up: only what lies between two skipped frames can be filled.
  if (skipping_ && *skipping_ < head.frame && seen_.stretch(*skipping_).last >= head.frame) {
    paused_.add({*skipping_, head.frame});
  } else {
    paused_.add(head.frame);
  }
  skipping_ = std::max(skipping_.value_or(0), head.frame);
}

void RunLedger::note_known(const FrameRange& range, FrameRanges& ranges) {
  newest_ = std::max(newest_, range.last);
  first_seen_ = std::min(first_seen_, range.first);
  ranges.add(range);
}

bool RunLedger::lose(const wire::FrameHead& head) {
  newest_ = std::max(newest_, head.frame);
  const bool was_complete = complete_.contains(head.frame);
  complete_.remove(head.frame);
  parts_.erase(head.frame);
  cut_.add(head.frame);
  return was_complete;
}

std::uint64_t RunLedger::joined_at() const {
  if (watched_) return 0;
  // A recorder that joins between two chunks of a frame cannot have that frame.
  const bool joined_within =
      !complete_.empty() && !complete_.contains(first_seen_) && cause_of(first_seen_) == GapCause::incomplete;
  return joined_within ? first_seen_ + 1 : first_seen_;
}

std::uint64_t RunLedger::in_progress() const {
  const auto newer = complete_.empty() ? parts_.begin() : parts_.upper_bound(complete_.last());
  return static_cast<std::uint64_t>(std::count_if(
      newer, parts_.end(), [&](const auto& part) { return may_become_complete(part.first, part.second); }));
}

bool RunLedger::may_become_complete(std::uint64_t frame, const std::vector<bool>& part) const {
  if (dropped_.contains(frame)) return false;
  // Those with the same chunk number come in the order of their frames.
  for (std::size_t chunk = 0; chunk < part.size(); ++chunk) {
    if (!part[chunk] && chunk < next_.size() && next_[chunk] > frame) return false;
  }
  return true;
}

std::uint64_t RunLedger::missing() const {
  return newest_ + 1 - joined_at() - complete_.size() - paused_.size() - in_progress();
}

std::uint64_t RunLedger::contiguous_end() const {
  std::uint64_t frame = joined_at();
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const FrameRanges* settled : {&complete_, &paused_, &unpublished_, &given_up_}) {
      const auto stretch = settled->stretch(frame);
      if (!stretch.contained) continue;
      frame = stretch.last + 1;
      goes_on = true;
    }
  }
  return frame;
}

GapCause RunLedger::cause_of(std::uint64_t frame) const {
  if (cut_.contains(frame)) return GapCause::disk;
  if (dropped_.contains(frame)) return GapCause::queue;
  if (seen_.contains(frame)) return GapCause::incomplete;
  return unpublished_.contains(frame) ? GapCause::unpublished : GapCause::lost;
}

RunSummary RunLedger::summary() const {
  RunSummary summary{.run_id = run_id_, .joined_at = joined_at()};
  if (complete_.empty()) return summary;
  summary.first_frame = complete_.first();
  summary.last_frame = complete_.last();
  summary.frames = complete_.size();
  // A restored checkpoint may go back before the first frame.
  summary.steps = last_.step - std::min(first_.step, last_.step);
  summary.seconds = last_.time - std::min(first_.time, last_.time);
  return summary;
}

std::vector<Gap> RunLedger::gaps() const {
  std::vector<Gap> gaps;
  for (std::uint64_t frame = joined_at(); frame <= newest_;) {
    std::uint64_t last = newest_;
    for (const FrameRanges* ranges : {&complete_, &paused_, &cut_, &dropped_, &seen_, &unpublished_}) {
      last = std::min(last, ranges->stretch(frame).last);
    }
    if (!complete_.contains(frame) && !paused_.contains(frame)) {
      const GapCause cause = cause_of(frame);
      const bool goes_on = !gaps.empty() && gaps.back().last + 1 == frame && gaps.back().cause == cause;
      if (goes_on) {
        gaps.back().last = last;
      } else {
        gaps.push_back({run_id_, frame, last, cause});
      }
    }
    if (last == newest_) break;
    frame = last + 1;
  }
  return gaps;
}

std::vector<Pause> RunLedger::pauses() const {
  std::vector<Pause> list;
  for (const FrameRange& range : paused_.ranges()) list.push_back({run_id_, range.first, range.last});
  return list;
}

}  // namespace flexcast::record
