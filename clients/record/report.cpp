#include "clients/record/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

namespace flexcast::record {
namespace {

std::string_view name_of(EndReason reason) {
  switch (reason) {
    case EndReason::stopped:
      return "stopped";
    case EndReason::frames:
      return "frames";
    case EndReason::duration:
      return "duration";
    case EndReason::failed:
      return "failed";
    case EndReason::recovered:
      return "recovered";
  }
  return "unknown";
}

constexpr std::size_t most_gap_lines = 100;

// What a cause means, for people.
std::string_view explain(GapCause cause) {
  switch (cause) {
    case GapCause::unpublished:
      return "the server did not publish them";
    case GapCause::lost:
      return "lost on the way";
    case GapCause::incomplete:
      return "some of their chunks are missing";
    case GapCause::queue:
      return "the disk was too slow";
    case GapCause::disk:
      return "the file could not take them";
  }
  return "";
}

std::string count(std::uint64_t n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string range_text(std::uint64_t first, std::uint64_t last) {
  return first == last ? fmt::format("frame {}", first) : fmt::format("frames {}..{}", first, last);
}

std::string gap_line(const Gap& gap) {
  const std::string frames = range_text(gap.first, gap.last);
  return fmt::format("  gap: run {}, {} ({}: {})\n", gap.run_id, frames, name_of(gap.cause), explain(gap.cause));
}

std::string gap_lines(const std::vector<Gap>& gaps) {
  std::string text;
  const std::size_t shown = std::min(gaps.size(), most_gap_lines);
  for (std::size_t i = 0; i < shown; ++i) text += gap_line(gaps[i]);
  if (shown == gaps.size()) return text;
  return text + fmt::format("  and {} more: flexcast.gaps in the file has them all\n", gaps.size() - shown);
}

// Frames of each cause that there is, in the order of the causes.
std::map<GapCause, std::uint64_t> count_causes(const std::vector<Gap>& gaps) {
  std::map<GapCause, std::uint64_t> frames;
  for (const Gap& gap : gaps) frames[gap.cause] += gap.last - gap.first + 1;
  return frames;
}

// "4 frames missing in 2 gaps: 1 lost, 3 incomplete"
std::string missing_line(const std::vector<Gap>& gaps) {
  std::uint64_t missing = 0;
  std::string causes;
  for (const auto& [cause, frames] : count_causes(gaps)) {
    missing += frames;
    causes += fmt::format("{}{} {}", causes.empty() ? ": " : ", ", frames, name_of(cause));
  }
  if (missing == 0) return "  no frame is missing\n";
  return fmt::format("  {} missing in {}{}\n", count(missing, "frame"), count(gaps.size(), "gap"), causes);
}

template <class Value>
std::uint64_t sum(const std::vector<RunSummary>& runs, Value RunSummary::*member) {
  return std::accumulate(runs.begin(), runs.end(), std::uint64_t{0},
                         [&](std::uint64_t total, const RunSummary& run) { return total + run.*member; });
}

}  // namespace

std::uint64_t frame_count(const Report& report) {
  return sum(report.reception.runs, &RunSummary::frames);
}

std::uint64_t step_count(const Report& report) {
  return sum(report.reception.runs, &RunSummary::steps);
}

std::uint64_t missing_count(const Report& report) {
  std::uint64_t frames = 0;
  for (const Gap& gap : report.reception.gaps) frames += gap.last - gap.first + 1;
  return frames;
}

std::uint64_t paused_count(const Report& report) {
  std::uint64_t frames = 0;
  for (const Pause& pause : report.reception.pauses) frames += pause.last - pause.first + 1;
  return frames;
}

std::uint64_t dropped_count(const Report& report) {
  std::uint64_t messages = 0;
  for (const auto& [topic, dropped] : report.reception.dropped) messages += dropped;
  return messages;
}

double simulated_seconds(const Report& report) {
  double seconds = 0;
  for (const RunSummary& run : report.reception.runs) seconds += run.seconds;
  return seconds;
}

std::string to_text(const Report& report) {
  const Reception& reception = report.reception;
  std::string text = fmt::format("{}: world {}, {} in {}\n", report.file, report.world,
                                 count(frame_count(report), "frame"), count(reception.runs.size(), "run"));
  text += fmt::format("  {}, {:.6g} s simulated, {:.3f} s recorded; {}, {:.3f} MB\n", count(step_count(report), "step"),
                      simulated_seconds(report), reception.seconds, count(report.messages, "message"),
                      static_cast<double>(report.bytes) / 1e6);
  for (const RunSummary& run : reception.runs) {
    if (run.joined_at > 0) text += fmt::format("  run {}: joined at frame {}\n", run.run_id, run.joined_at);
  }
  for (const Pause& pause : reception.pauses) {
    text += fmt::format("  paused: run {}, {}\n", pause.run_id, range_text(pause.first, pause.last));
  }
  text += gap_lines(reception.gaps);
  for (const auto& [topic, dropped] : reception.dropped) {
    text += fmt::format("  dropped: {} of {}\n", count(dropped, "message"), wire::topic(topic).name);
  }
  if (reception.unreadable > 0) text += fmt::format("  unreadable: {}\n", count(reception.unreadable, "message"));
  if (const std::uint64_t paused = paused_count(report); paused > 0) {
    text += fmt::format("  {} not recorded while paused\n", count(paused, "frame"));
  }
  return text + missing_line(reception.gaps);
}

std::string to_json(const Report& report) {
  using Json = nlohmann::ordered_json;
  Json missing = Json::array();
  for (const Gap& gap : report.reception.gaps) {
    missing.push_back(
        {{"run_id", gap.run_id}, {"first", gap.first}, {"last", gap.last}, {"cause", name_of(gap.cause)}});
  }
  Json runs = Json::array();
  for (const RunSummary& run : report.reception.runs) {
    runs.push_back({{"run_id", run.run_id},
                    {"first_frame", run.first_frame},
                    {"last_frame", run.last_frame},
                    {"frames", run.frames},
                    {"joined_at", run.joined_at}});
  }
  Json causes = Json::object();
  for (const auto& [cause, frames] : count_causes(report.reception.gaps)) causes[name_of(cause)] = frames;
  Json paused = Json::array();
  for (const Pause& pause : report.reception.pauses) {
    paused.push_back({{"run_id", pause.run_id}, {"first", pause.first}, {"last", pause.last}});
  }
  Json json{{"file", report.file},
            {"world", report.world},
            {"frames", frame_count(report)},
            {"gaps", missing_count(report)},
            {"missing", missing},
            {"causes", causes},
            {"paused", paused},
            {"paused_frames", paused_count(report)},
            {"runs", runs},
            {"bytes", report.bytes},
            {"seconds", report.reception.seconds},
            {"messages", report.messages},
            {"dropped", dropped_count(report)},
            {"simulated_seconds", simulated_seconds(report)},
            {"steps", step_count(report)}};
  if (!report.parts.empty()) json["parts"] = report.parts;
  if (!report.failure.empty()) json["failure"] = report.failure;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

mcap::TextPairs gaps_metadata(const Report& report) {
  const std::vector<Gap>& gaps = report.reception.gaps;
  mcap::TextPairs pairs{{"missing", std::to_string(missing_count(report))}, {"gaps", std::to_string(gaps.size())}};
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const Gap& gap = gaps[i];
    pairs[fmt::format("gap.{}", i)] = fmt::format("{} {} {} {}", gap.run_id, gap.first, gap.last, name_of(gap.cause));
  }
  pairs["paused"] = std::to_string(paused_count(report));
  for (std::size_t i = 0; i < report.reception.pauses.size(); ++i) {
    const Pause& pause = report.reception.pauses[i];
    pairs[fmt::format("pause.{}", i)] = fmt::format("{} {} {}", pause.run_id, pause.first, pause.last);
  }
  return pairs;
}

mcap::TextPairs recording_metadata(const Report& report) {
  const Reception& reception = report.reception;
  mcap::TextPairs pairs{{"world", report.world},
                        {"version", FLEXCAST_VERSION},
                        {"server_version", reception.server_version},
                        {"ended", std::string(name_of(reception.end))},
                        {"frames", std::to_string(frame_count(report))},
                        {"dropped", std::to_string(dropped_count(report))},
                        {"unreadable", std::to_string(reception.unreadable)},
                        {"seconds", fmt::format("{:.9f}", reception.seconds)},
                        {"runs", std::to_string(reception.runs.size())}};
  if (report.domain >= 0) pairs["domain"] = std::to_string(report.domain);
  if (report.domain >= 0) pairs["profile"] = report.profile;
  for (const auto& [topic, dropped] : reception.dropped) {
    pairs[std::string("dropped.") + wire::topic(topic).name] = std::to_string(dropped);
  }
  for (std::size_t i = 0; i < reception.runs.size(); ++i) {
    const RunSummary& run = reception.runs[i];
    pairs[fmt::format("run.{}", i)] =
        fmt::format("{} {} {} {} {}", run.run_id, run.first_frame, run.last_frame, run.frames, run.joined_at);
  }
  return pairs;
}

}  // namespace flexcast::record
