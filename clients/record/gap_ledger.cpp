#include "clients/record/gap_ledger.h"

namespace flexcast::record {
namespace {

// Of 1 MiB each; a larger number is no frame.
constexpr std::uint32_t most_chunks = 65536;

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
  return runs_.emplace_back(head.run_id, watched, head.frame);
}

Verdict GapLedger::judge(const wire::FrameHead& head) const {
  if (head.chunk >= head.chunks || head.chunks > most_chunks) return Verdict::invalid;
  const RunLedger* run = find(head.run_id);
  if (run && run->is_repeated(head)) return Verdict::repeated;
  const bool is_new = !run || run->is_new(head.frame);
  if (is_full() || (is_new && (closed_ || most_frames_ - frames_ <= in_progress()))) return Verdict::beyond;
  return Verdict::record;
}

void GapLedger::add(const wire::FrameHead& head, std::uint64_t writer) {
  if (open(head, writer).add(head)) ++frames_;
}

void GapLedger::drop(const wire::FrameHead& head, std::uint64_t writer) {
  open(head, writer).drop(head);
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

}  // namespace flexcast::record
