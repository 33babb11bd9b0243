#include "clients/export/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexcast::exporting {
namespace {

std::string one_run(const recording::Index& index, std::size_t run) {
  const recording::RunEntry& entry = index.runs()[run];
  const auto frames = index.frames().subspan(entry.begin, entry.end - entry.begin);
  return fmt::format("run {} (id {}: {} frame{}, {:.6g} s to {:.6g} s)", run + 1, entry.run_id, frames.size(),
                     frames.size() == 1 ? "" : "s", frames.front().time, frames.back().time);
}

// 0.3 includes the frame of 3 x 0.1 s, whatever the rounding.
double calc_slack(double time) {
  return 1e-9 * std::max(1.0, std::abs(time));
}

}  // namespace

wire::Result<Selection> select(const recording::Index& index, const Options& options) {
  const auto runs = index.runs();
  const std::size_t run = options.run.value_or(runs.size()) - 1;
  if (run >= runs.size()) {
    return wire::Error{fmt::format("{}: there is no run {}; --run takes 1 to {}", options.file, run + 1, runs.size())};
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double from = options.from ? *options.from - calc_slack(*options.from) : -infinity;
  const double to = options.to ? *options.to + calc_slack(*options.to) : infinity;
  Selection selection{run, runs[run].run_id, {}, {}};
  std::uint64_t seen = 0, next_number = 0;
  for (std::size_t i = runs[run].begin; i < runs[run].end; ++i) {
    const recording::FrameEntry& frame = index.frames()[i];
    if (!(frame.time >= from && frame.time <= to)) continue;
    if (seen > 0 && frame.number > next_number) selection.missing.push_back({next_number, frame.number - 1});
    next_number = frame.number + 1;
    if (seen++ % options.every == 0) selection.frames.push_back(i);
  }
  if (selection.frames.empty()) {
    return wire::Error{fmt::format("{}: {} has no frame at these times", options.file, one_run(index, run))};
  }
  return selection;
}

std::string describe_run(const recording::Index& index, std::size_t run) {
  std::string text = one_run(index, run);
  const std::size_t count = index.runs().size();
  if (count == 1) return text;
  text += fmt::format(" of {}; the others:", count);
  for (std::size_t other = 0; other < count; ++other) {
    if (other != run) text += " " + one_run(index, other);
  }
  return text;
}

}  // namespace flexcast::exporting
