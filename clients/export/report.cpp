#include "clients/export/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace flexcast::exporting {
namespace {

std::string count(std::uint64_t number, const char* what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

}  // namespace

std::string to_text(const Summary& summary) {
  return fmt::format("{}: {}, {}, {:.3f} MB", summary.output, count(summary.frames, "frame"),
                     count(summary.files, "file"), static_cast<double>(summary.bytes) / 1e6);
}

std::string to_json(const Summary& summary, const Selection& selection, const std::string& file) {
  using Json = nlohmann::ordered_json;
  Json missing = Json::array();
  for (const MissingFrames& range : selection.missing)
    missing.push_back({{"first", range.first}, {"last", range.last}});
  const Json json{{"file", file},
                  {"run", selection.run + 1},
                  {"run_id", selection.run_id},
                  {"frames", summary.frames},
                  {"files", summary.files},
                  {"bytes", summary.bytes},
                  {"output", summary.output},
                  {"fields", summary.fields},
                  {"missing", missing},
                  {"incomplete", summary.incomplete}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string missing_text(const Selection& selection, const Summary& summary) {
  constexpr std::size_t most = 100;
  std::vector<MissingFrames> ranges = selection.missing;
  for (const std::uint64_t number : summary.incomplete) ranges.push_back({number, number});
  if (ranges.empty()) return "";
  std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::uint64_t frames = 0;
  std::string list;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto& [first, last] = ranges[i];
    frames += last - first + 1;
    if (i >= most) continue;
    list += fmt::format("{}{}", i == 0 ? "" : ", ", first);
    if (last > first) list += fmt::format("-{}", last);
  }
  if (ranges.size() > most) list += ", ...";
  return fmt::format("{} missing in the recording: {}",
                     frames == 1 ? "1 frame is" : fmt::format("{} frames are", frames), list);
}

}  // namespace flexcast::exporting
