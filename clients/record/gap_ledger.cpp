#include "clients/record/gap_ledger.h"

#include <algorithm>

namespace flexcast::record {
namespace {

// Of 1 MiB each; a larger number is no frame.
constexpr std::uint32_t most_chunks = 65536;

// Runs that no frame came from yet: a status names the newest ranges again and again.
constexpr std::size_t most_early_runs = 16;

std::vector<FrameRange> sensible_ranges(std::span<const std::uint64_t> numbers) {
  std::vector<FrameRange> ranges;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    if (numbers[i] <= numbers[i + 1]) ranges.push_back({numbers[i], numbers[i + 1]});
  }
  return ranges;
}

}  // namespace

const RunLedger* GapLedger::find(std::uint64_t run_id) const {
  for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
    if (run->run_id() == run_id) return &*run;
  }
  return nullptr;
}

RunLedger& GapLedger::open(const wire::FrameHead& head, std::uint64_t writer) {
  if (!runs_.empty() && runs_[current_].run_id() == head.run_id) return runs_[current_];
  const bool watched = !writers_.insert(writer).second;
  for (current_ = runs_.size(); current_ > 0;) {
    if (runs_[--current_].run_id() == head.run_id) return runs_[current_];
  }
  current_ = runs_.size();
  RunLedger& run = runs_.emplace_back(head.run_id, watched, head.frame);
  for (const FrameRange& range : std::exchange(early_[head.run_id], {})) run.note_unpublished(range);
  early_.erase(head.run_id);
  return run;
}

void GapLedger::resume() {
  paused_ = false;
  for (RunLedger& run : runs_) run.resume();
}

Verdict GapLedger::judge(const wire::FrameHead& head) const {
  if (head.chunk >= head.chunks || head.chunks > most_chunks) return Verdict::invalid;
  const RunLedger* run = find(head.run_id);
  if (run && run->is_repeated(head)) return Verdict::repeated;
  const bool is_new = !run || run->is_new(head.frame);
  if (run && run->is_skipped(head.frame)) return Verdict::paused;
  if (is_new && paused_ && !closed_) return Verdict::paused;
  if (is_full() || (is_new && (closed_ || most_frames_ - frames_ <= in_progress()))) return Verdict::beyond;
  return Verdict::record;
}

void GapLedger::add(const wire::FrameHead& head, std::uint64_t writer) {
  if (open(head, writer).add(head)) ++frames_;
}

void GapLedger::drop(const wire::FrameHead& head, std::uint64_t writer) {
  open(head, writer).drop(head);
}

void GapLedger::pass(const wire::FrameHead& head) {
  if (RunLedger* run = find(head.run_id)) run->pass(head);
}

void GapLedger::skip(const wire::FrameHead& head, std::uint64_t writer) {
  open(head, writer).skip(head);
}

void GapLedger::note_unpublished(std::uint64_t run_id, std::span<const std::uint64_t> numbers) {
  const std::vector<FrameRange> ranges = sensible_ranges(numbers);
  if (ranges.empty()) return;
  if (RunLedger* run = find(run_id)) {
    for (const FrameRange& range : ranges) run->note_unpublished(range);
  } else if (early_.size() < most_early_runs || early_.contains(run_id)) {
    early_[run_id] = ranges;
  }
}

void GapLedger::lose(const wire::FrameHead& head) {
  RunLedger* run = find(head.run_id);
  if (run && run->lose(head)) --frames_;
}

bool GapLedger::has_lost() const {
  const std::vector<Gap> all = gaps();
  return std::any_of(all.begin(), all.end(), [](const Gap& gap) { return gap.cause == GapCause::lost; });
}

std::uint64_t GapLedger::missing() const {
  std::uint64_t frames = 0;
  for (const RunLedger& run : runs_) frames += run.missing();
  return frames;
}

std::vector<RunSummary> GapLedger::runs() const {
  std::vector<RunSummary> list;
  for (const RunLedger& run : runs_) list.push_back(run.summary());
  return list;
}

std::vector<Gap> GapLedger::gaps() const {
  std::vector<Gap> list;
  for (const RunLedger& run : runs_) {
    const std::vector<Gap> gaps = run.gaps();
    list.insert(list.end(), gaps.begin(), gaps.end());
  }
  return list;
}

std::vector<Pause> GapLedger::pauses() const {
  std::vector<Pause> list;
  for (const RunLedger& run : runs_) {
    const std::vector<Pause> pauses = run.pauses();
    list.insert(list.end(), pauses.begin(), pauses.end());
  }
  return list;
}

}  // namespace flexcast::record
