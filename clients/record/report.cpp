#include "clients/record/report.h"

#include <fmt/format.h>

#include <algorithm>
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
  }
  return "unknown";
}

constexpr std::size_t most_gap_lines = 100;

// What a cause means, for people.
std::string_view explain(GapCause cause) {
  switch (cause) {
    case GapCause::not_received:
      return "not published, or lost on the way";
    case GapCause::incomplete:
      return "some of their chunks are missing";
    case GapCause::queue:
      return "the disk was too slow";
  }
  return "";
}

std::string count(std::uint64_t n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string gap_line(const Gap& gap) {
  const std::string frames =
      gap.first == gap.last ? fmt::format("frame {}", gap.first) : fmt::format("frames {}..{}", gap.first, gap.last);
  return fmt::format("  gap: run {}, {} ({}: {})\n", gap.run_id, frames, name_of(gap.cause), explain(gap.cause));
}

std::string gap_lines(const std::vector<Gap>& gaps) {
  std::string text;
  const std::size_t shown = std::min(gaps.size(), most_gap_lines);
  for (std::size_t i = 0; i < shown; ++i) text += gap_line(gaps[i]);
  if (shown == gaps.size()) return text;
  return text + fmt::format("  and {} more: flexcast.gaps in the file has them all\n", gaps.size() - shown);
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
  text += gap_lines(reception.gaps);
  for (const auto& [topic, dropped] : reception.dropped) {
    text += fmt::format("  dropped: {} of {}\n", count(dropped, "message"), wire::topic(topic).name);
  }
  if (reception.unreadable > 0) text += fmt::format("  unreadable: {}\n", count(reception.unreadable, "message"));
  const std::uint64_t missing = missing_count(report);
  return text + (missing == 0 ? std::string("  no frame is missing\n")
                              : fmt::format("  {} missing in {}\n", count(missing, "frame"),
                                            count(reception.gaps.size(), "gap")));
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
  const Json json{{"file", report.file},
                  {"world", report.world},
                  {"frames", frame_count(report)},
                  {"gaps", missing_count(report)},
                  {"missing", missing},
                  {"runs", runs},
                  {"bytes", report.bytes},
                  {"seconds", report.reception.seconds},
                  {"messages", report.messages},
                  {"dropped", dropped_count(report)},
                  {"simulated_seconds", simulated_seconds(report)},
                  {"steps", step_count(report)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

mcap::TextPairs gaps_metadata(const Report& report) {
  const std::vector<Gap>& gaps = report.reception.gaps;
  mcap::TextPairs pairs{{"missing", std::to_string(missing_count(report))}, {"gaps", std::to_string(gaps.size())}};
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const Gap& gap = gaps[i];
    pairs[fmt::format("gap.{}", i)] = fmt::format("{} {} {} {}", gap.run_id, gap.first, gap.last, name_of(gap.cause));
  }
  return pairs;
}

mcap::TextPairs recording_metadata(const Report& report) {
  const Reception& reception = report.reception;
  mcap::TextPairs pairs{{"world", report.world},
                        {"domain", std::to_string(report.domain)},
                        {"profile", report.profile},
                        {"version", FLEXCAST_VERSION},
                        {"server_version", reception.server_version},
                        {"ended", std::string(name_of(reception.end))},
                        {"frames", std::to_string(frame_count(report))},
                        {"dropped", std::to_string(dropped_count(report))},
                        {"unreadable", std::to_string(reception.unreadable)},
                        {"seconds", fmt::format("{:.9f}", reception.seconds)},
                        {"runs", std::to_string(reception.runs.size())}};
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
