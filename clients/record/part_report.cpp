#include "clients/record/part_report.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace flexcast::record {
namespace {

constexpr std::uint64_t endless = std::numeric_limits<std::uint64_t>::max();

// Gap or Pause: those of `run_id` within [first, last], cut to it.
template <class Range>
void keep_within(const std::vector<Range>& all, std::uint64_t run_id, std::uint64_t first, std::uint64_t last,
                 std::vector<Range>& kept) {
  for (Range range : all) {
    range.first = std::max(range.first, first);
    range.last = std::min(range.last, last);
    if (range.run_id == run_id && range.first <= range.last) kept.push_back(range);
  }
}

const RunSummary* find(const std::vector<RunSummary>& runs, std::uint64_t run_id) {
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const auto& run) { return run.run_id == run_id; });
  return found == runs.end() ? nullptr : &*found;
}

}  // namespace

Report PartReports::divide(Report whole, const ContentLedger& content, bool last) {
  const Reception all = std::exchange(whole.reception, content.reception());
  Reception& part = whole.reception;
  part.end = all.end;
  part.dropped = all.dropped;
  part.server_version = all.server_version;
  const std::vector<RunSummary> there = std::exchange(part.runs, {});
  part.gaps.clear();
  part.pauses.clear();
  divided_ = next_;
  for (const RunSummary& run : all.runs) {
    const RunSummary* in_part = find(there, run.run_id);
    const std::uint64_t first = next_.contains(run.run_id) ? next_.at(run.run_id) : run.joined_at;
    const bool goes_on = !last && run.run_id == content.frames().run_id();
    if (first == endless || (in_part == nullptr && !last)) continue;
    const std::uint64_t end = goes_on ? content.frames().next_frame() - 1 : endless;
    keep_within(all.gaps, run.run_id, first, end, part.gaps);
    keep_within(all.pauses, run.run_id, first, end, part.pauses);
    divided_[run.run_id] = goes_on ? end + 1 : endless;
    if (in_part == nullptr) continue;
    part.runs.push_back(*in_part);
    part.runs.back().joined_at = first;
  }
  return whole;
}

Report restrict_report(Report whole, const ContentLedger& content) {
  Reception left = content.reception();
  left.end = whole.reception.end;
  left.dropped = whole.reception.dropped;
  left.error = whole.reception.error;
  left.gaps.clear();
  left.pauses.clear();
  for (const RunSummary& run : left.runs) {
    keep_within(whole.reception.gaps, run.run_id, run.first_frame, endless, left.gaps);
    keep_within(whole.reception.pauses, run.run_id, run.first_frame, endless, left.pauses);
  }
  for (RunSummary& run : left.runs) run.joined_at = run.first_frame;
  whole.reception = std::move(left);
  return whole;
}

}  // namespace flexcast::record
