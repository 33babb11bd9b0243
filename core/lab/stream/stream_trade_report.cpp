#include "core/lab/stream/stream_trade_report.h"

#include <cmath>
#include <cstdio>

#include "core/lab/output_file.h"

namespace flexcast {
namespace {

using Json = nlohmann::ordered_json;

constexpr double targets[] = {1e-3, 1e-4, 1e-6};

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string join(const std::vector<std::string>& fields, const char* between) {
  std::string text;
  for (const std::string& field : fields) text += (text.empty() ? "" : between) + field;
  return text;
}

// 830 B/s, 12.3 kB/s, 4.56 MB/s.
std::string rate_text(double bytes_per_second) {
  if (bytes_per_second >= 1e6) return format("%.3g MB/s", bytes_per_second / 1e6);
  if (bytes_per_second >= 1e3) return format("%.3g kB/s", bytes_per_second / 1e3);
  return format("%.3g B/s", bytes_per_second);
}

std::string row_text(const StreamTradeRow& row) {
  const std::string relative = std::isfinite(row.relative_error) ? format("%.2e", row.relative_error) : "-";
  const std::string fields = row.fields.size() > 2 ? "all" : join(row.fields, ", ");
  return format("  %-11s  %-21s  %5d  %11zu  %12.0f  %9.2e  %8s  %10.3g\n", row.precision.c_str(), fields.c_str(),
                row.every, row.frame_bytes, row.bytes_per_second, row.error, relative.c_str(),
                1e6 * row.prepare_seconds);
}

std::string cheapest_text(const StreamTrade& trade) {
  std::string text;
  for (const double target : targets) {
    const StreamTradeRow* row = find_cheapest(trade, target);
    text += text.empty() ? "cheapest positions within " : "; within ";
    text += format("%.0e of the size: ", target);
    text += row ? row->precision + (row->every > 1 ? format(", every %d steps, ", row->every) : ", every step, ") +
                      rate_text(row->bytes_per_second)
                : "none";
  }
  return text + "\n";
}

Json finite(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace

std::string make_stream_trade_text(const StreamTrade& trade) {
  std::string text =
      trade.scene + format(": %lld particles, ", static_cast<long long>(trade.particles)) + trade.integrator +
      format(", %lld steps, %.6g s, size %.4g m\n", static_cast<long long>(trade.steps), trade.time, trade.size);
  text += format("  %-11s  %-21s  %5s  %11s  %12s  %9s  %8s  %10s\n", "precision", "fields", "every", "bytes/frame",
                 "bytes/s", "error, m", "of size", "prepare us");
  for (const StreamTradeRow& row : trade.rows) text += row_text(row);
  text += "all: " + join(trade.rows.back().fields, ", ") +
          ".\n"
          "bytes/s: of simulated time. error: of positions, the largest of the run; for every > 1 also between the\n"
          "frames, where a viewer moves particles in straight lines. prepare: fields, hash, bounds and conversion;\n"
          "DDS's own write is not in it.\n";
  return text + cheapest_text(trade);
}

std::string make_stream_trade_csv(const StreamTrade& trade) {
  std::string text = "precision,fields,every,frame_bytes,bytes_per_second,error_m,relative_error,prepare_seconds\n";
  for (const StreamTradeRow& row : trade.rows) {
    text += row.precision + "," + join(row.fields, "+") + format(",%d,%zu,", row.every, row.frame_bytes) +
            exact_text(row.bytes_per_second) + "," + exact_text(row.error) + "," +
            (std::isfinite(row.relative_error) ? exact_text(row.relative_error) : "") + "," +
            exact_text(row.prepare_seconds) + "\n";
  }
  return text;
}

Json make_stream_trade_json(const StreamTrade& trade) {
  Json rows = Json::array(), cheapest = Json::array();
  for (const StreamTradeRow& row : trade.rows) {
    rows.push_back({{"precision", row.precision},
                    {"fields", row.fields},
                    {"every", row.every},
                    {"frame_bytes", row.frame_bytes},
                    {"bytes_per_second", row.bytes_per_second},
                    {"error", finite(row.error)},
                    {"relative_error", finite(row.relative_error)},
                    {"prepare_seconds", row.prepare_seconds}});
  }
  for (const double target : targets) {
    const StreamTradeRow* row = find_cheapest(trade, target);
    Json entry = {
        {"relative_error", target}, {"precision", nullptr}, {"every", nullptr}, {"bytes_per_second", nullptr}};
    if (row)
      entry.update({{"precision", row->precision}, {"every", row->every}, {"bytes_per_second", row->bytes_per_second}});
    cheapest.push_back(std::move(entry));
  }
  return {{"scene", trade.scene},
          {"integrator", trade.integrator},
          {"particles", trade.particles},
          {"steps", trade.steps},
          {"time", trade.time},
          {"size", trade.size},
          {"rows", rows},
          {"cheapest", cheapest}};
}

}  // namespace flexcast
