#include "clients/verify/verify.h"

#include <algorithm>
#include <set>

#include "clients/verify/rerun.h"

namespace flexcast::verify {
namespace {

// Whether it goes back to a checkpoint of an earlier run.
bool needs_earlier_runs(const RecordedRun& run) {
  std::set<std::string> saved;
  for (const auto& [index, event] : run.events) {
    if (event.kind != server::EventKind::command) continue;
    if (event.command == server::CommandKind::save) saved.insert(event.name);
    if (event.command == server::CommandKind::restore && !saved.contains(event.name)) return true;
  }
  return false;
}

std::int64_t find_last_step(const RecordedRun& run) {
  std::int64_t last = 0;
  for (const RecordedFrame& frame : run.frames) last = std::max(last, frame.step);
  return last;
}

// Place of the run in the list, or its size.
std::size_t find_run(const std::vector<RecordedRun>& runs, std::uint64_t wanted) {
  if (wanted >= 1 && wanted <= runs.size()) return static_cast<std::size_t>(wanted - 1);
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const auto& run) { return run.run_id == wanted; });
  return static_cast<std::size_t>(found - runs.begin());
}

void warn_of_version(Report& report, const std::string& version) {
  if (version.empty() || version == FLEXCAST_VERSION) return;
  const std::string text = "flexcast-server " + version + " made this recording, this is flexcast-verify " +
                           FLEXCAST_VERSION + ": another version may compute other bits";
  if (std::find(report.warnings.begin(), report.warnings.end(), text) == report.warnings.end()) {
    report.warnings.push_back(text);
  }
}

}  // namespace

bool Report::verified() const {
  const bool sound = std::all_of(runs.begin(), runs.end(), [](const RunReport& run) {
    return run.verdict == Verdict::equal || run.verdict == Verdict::empty;
  });
  return sound && std::any_of(runs.begin(), runs.end(), [](const RunReport& run) { return run.frames > 0; });
}

wire::Result<Report> verify_recording(recording::Recording& recording, std::optional<std::uint64_t> only,
                                      const ShowProgress& show) {
  auto read = read_runs(recording);
  if (!read) return read.error();
  std::vector<RecordedRun> runs = std::move(read).value();
  // Of runs before the recording there may be events, which late joiners get.
  std::erase_if(runs, [](const RecordedRun& run) { return !run.scene && run.frames.empty(); });
  Report report{recording.path(), {}, {}};
  if (!recording.trouble().empty()) report.warnings.push_back(recording.trouble());
  if (runs.empty()) return wire::Error{recording.path() + ": there is no run in this recording"};

  const std::size_t wanted = only ? find_run(runs, *only) : 0;
  if (wanted == runs.size()) {
    return wire::Error{recording.path() + ": there is no run " + std::to_string(*only) + "; it has " +
                       std::to_string(runs.size()) + (runs.size() == 1 ? " run" : " runs, 1 to ") +
                       (runs.size() == 1 ? "" : std::to_string(runs.size()))};
  }
  const std::size_t first = only && !needs_earlier_runs(runs[wanted]) ? wanted : 0;
  const std::size_t end = only ? wanted + 1 : runs.size();
  SavedCheckpoints checkpoints;
  bool going = true;
  for (std::size_t i = first; i < end && going; ++i) {
    Progress progress{i + 1, runs.size(), 0, find_last_step(runs[i])};
    const KeepGoing keep_going = [&](std::int64_t step) {
      progress.step = step;
      return going = show(progress);
    };
    RunReport run = Rerun(runs[i], checkpoints, keep_going).execute();
    run.number = i + 1;
    warn_of_version(report, run.server_version);
    if (!only || i == wanted || !going) report.runs.push_back(std::move(run));
  }
  return report;
}

}  // namespace flexcast::verify
