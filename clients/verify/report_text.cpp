#include "clients/verify/report_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace flexcast::verify {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_gaps = 20;  // lines of text a run

std::string hash_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

std::string difference_text(const Difference& difference) {
  std::string text =
      fmt::format("  first difference: frame {}, step {}, {:.6g} s: recorded {}, computed {}, after {}\n",
                  difference.recorded.frame, difference.recorded.step, difference.recorded.time,
                  hash_text(difference.recorded.state_hash), hash_text(difference.computed_hash), difference.after);
  if (difference.step != difference.recorded.step) text += fmt::format("  it is step {} here\n", difference.step);
  return text;
}

std::string gaps_text(const RunReport& run) {
  if (run.gaps.empty()) return {};
  std::string text = fmt::format("  {} frames are not in the recording:", run.missing_frames);
  for (std::size_t i = 0; i < run.gaps.size() && i < most_gaps; ++i) {
    const auto& [first, last] = run.gaps[i];
    text += first == last ? fmt::format(" {}", first) : fmt::format(" {}-{}", first, last);
  }
  if (run.gaps.size() > most_gaps) text += fmt::format(" and {} ranges more", run.gaps.size() - most_gaps);
  return text + "\n";
}

std::string run_text(const RunReport& run) {
  std::string verdict(name_of(run.verdict));
  if (run.verdict == Verdict::not_verifiable) verdict = "NOT VERIFIABLE";
  if (run.verdict == Verdict::differs) verdict = "DIFFERS";
  std::string text =
      fmt::format("run {} ({}, scene {}): {}, {} frames compared over {} steps and {} events\n", run.number, run.run_id,
                  run.scene.empty() ? "unknown" : run.scene, verdict, run.frames, run.steps, run.events);
  if (!run.reason.empty()) text += "  " + run.reason + "\n";
  if (run.first_difference) text += difference_text(*run.first_difference);
  return text + gaps_text(run);
}

Json difference_json(const Difference& difference) {
  return {{"frame", difference.recorded.frame},
          {"step", difference.step},
          {"time", difference.recorded.time},
          {"recorded_step", difference.recorded.step},
          {"recorded_hash", hash_text(difference.recorded.state_hash)},
          {"computed_hash", hash_text(difference.computed_hash)},
          {"after", difference.after}};
}

Json run_json(const RunReport& run) {
  Json json{{"number", run.number},
            {"run_id", run.run_id},
            {"world", run.world},
            {"scene", run.scene},
            {"server_version", run.server_version},
            {"verdict", name_of(run.verdict)},
            {"reason", run.reason},
            {"steps", run.steps},
            {"events", run.events},
            {"frames", run.frames},
            {"differing", run.differing},
            {"missing_frames", run.missing_frames},
            {"gaps", Json::array()},
            {"first_difference", nullptr}};
  for (const auto& [first, last] : run.gaps) json["gaps"].push_back({{"first", first}, {"last", last}});
  if (run.first_difference) json["first_difference"] = difference_json(*run.first_difference);
  return json;
}

}  // namespace

std::string to_text(const Report& report) {
  std::string text;
  std::uint64_t frames = 0;
  for (const RunReport& run : report.runs) {
    text += run_text(run);
    frames += run.frames;
  }
  return text + fmt::format("{}: {}\n", report.file,
                            report.verified() ? fmt::format("verified, {} frames equal to the last bit", frames)
                                              : "not verified");
}

std::string to_json(const Report& report) {
  Json json{{"file", report.file}, {"verified", report.verified()}, {"warnings", report.warnings}};
  json["runs"] = Json::array();
  for (const RunReport& run : report.runs) json["runs"].push_back(run_json(run));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace flexcast::verify
