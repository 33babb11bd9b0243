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
  return begin(head.run_id, watched || watched_.contains(head.run_id), head.frame);
}

RunLedger& GapLedger::open(std::uint64_t run_id, std::uint64_t first_frame) {
  RunLedger* run = find(run_id);
  return run ? *run : begin(run_id, watched_.contains(run_id), first_frame);
}

RunLedger& GapLedger::begin(std::uint64_t run_id, bool watched, std::uint64_t first_frame) {
  current_ = runs_.size();
  RunLedger& run = runs_.emplace_back(run_id, watched, first_frame);
  for (const FrameRange& range : std::exchange(early_[run_id], {})) run.note_unpublished(range);
  early_.erase(run_id);
  if (watched) news_of_watched_.push_back(run_id);
  return run;
}

void GapLedger::note_news(const wire::FrameHead& head) {
  const auto [entry, is_new] = news_.try_emplace(head.run_id, News{head.frame, head.frame, true});
  if (is_new) return;
  News& news = entry->second;
  // From the newest that was told on: skip() fills what is between two frames.
  news.first = std::min(news.fresh ? news.first : news.newest, head.frame);
  news.newest = std::max(news.newest, head.frame);
  news.fresh = true;
}

AccountNote GapLedger::take_news() {
  AccountNote note{.watched = std::exchange(news_of_watched_, {}), .paused = {}, .dropped = {}, .messages = {}};
  for (auto& [run_id, news] : news_) {
    if (!std::exchange(news.fresh, false)) continue;
    const RunLedger& run = *find(run_id);
    for (const auto& [first, last] : run.paused_from(news.first)) note.paused.push_back({run_id, first, last});
    for (const auto& [first, last] : run.dropped_from(news.first)) note.dropped.push_back({run_id, first, last});
  }
  return note;
}

void GapLedger::note(const AccountNote& account) {
  for (const std::uint64_t run_id : account.watched) {
    watched_.insert(run_id);
    if (RunLedger* run = find(run_id)) run->note_watched();
  }
  for (const auto& [run_id, first, last] : account.paused) open(run_id, first).note_paused({first, last});
  for (const auto& [run_id, first, last] : account.dropped) open(run_id, first).note_dropped({first, last});
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
  note_news(head);
}

void GapLedger::pass(const wire::FrameHead& head) {
  if (RunLedger* run = find(head.run_id)) run->pass(head);
}

void GapLedger::skip(const wire::FrameHead& head, std::uint64_t writer) {
  open(head, writer).skip(head);
  note_news(head);
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
