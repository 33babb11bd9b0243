#include "core/lab/trade/trade_report.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace flexcast {
namespace {

using Status = TradeResult::Status;

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char text[512];
  std::va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

// A fraction in percent, two digits.
std::string percent_text(double fraction) {
  if (fraction > 10.0) return "> 1000 %";
  return format(fraction != 0.0 && fraction < 1e-5 ? "%.1e %%" : "%.2g %%", 100.0 * fraction);
}

std::size_t find_label_width(const Trade& trade) {
  std::size_t width = 7;
  for (const TradeResult& result : trade.results) width = std::max(width, result.setting.label.size());
  return width;
}

std::string make_row(const TradeResult& result, const Trade& trade, std::size_t width) {
  std::string row = format("%s%s %-*s ", result.on_front ? "*" : " ", result.at_limit ? "~" : " ",
                           static_cast<int>(width), result.setting.label.c_str());
  row += result.h > 0.0 ? format("%10.3g", result.h) : format("%10s", "-");
  if (result.status != Status::done) return row + "  " + result.cause + "\n";
  const TradeErrors& errors = result.errors;
  row += format(" %10.3g %10s %10s %10.2g %10.2g", result.cost, percent_text(result.error).c_str(),
                percent_text(errors.rms / trade.size).c_str(), errors.largest, errors.energy);
  row += trade.has_volumes ? format(" %10.2g", errors.volume) : format(" %10s", "-");
  return row + format(" %5zu\n", result.samples.size());
}

std::string make_group_line(const Trade& trade, std::size_t group) {
  const TradeGroup& of = trade.groups[group];
  const int order = of.row->order;
  const auto& observed = trade.orders[group];
  if (order == 0 && !observed) return of.name + "\n";
  std::string line = of.name + ": order ";
  line += observed ? format("%.2f observed over %d settings", observed->order, observed->settings) : "not observed";
  return line + (order > 0 ? format(", %d by theory\n", order) : "\n");
}

std::string make_head(const Trade& trade) {
  const TradeMesh& finest = trade.meshes.all[trade.meshes.finest];
  std::string text = format("%s: %g s, %zu of %lld frames compared", trade.scene.c_str(), trade.times.duration(),
                            trade.times.compared.size(), static_cast<long long>(trade.times.frames()));
  text += format("; %zu of %lld particles compared", finest.compared.size(),
                 static_cast<long long>(trade.meshes.base_particles));
  text += format("; %d thread%s, %.3g of %g s spent\n", trade.threads, trade.threads > 1 ? "s" : "", trade.spent,
                 trade.budget);
  text += format(
      "the scene is %.4g m large, the motion %.4g m; errors are the largest over time of the RMS over "
      "particles\n",
      trade.size, trade.motion);
  return text + make_reference_sentence(trade) + "\n";
}

}  // namespace

std::string make_reference_sentence(const Trade& trade) {
  const TradeReference& reference = trade.reference;
  if (!reference.exact.empty()) return "reference: exact, " + reference.exact + " (" + reference.label + ")";
  std::string text =
      "reference: " + reference.label + ", own error " + percent_text(trade.own_error()) + " of the motion";
  text += format(" (%.2g m, by halving the step over %zu runs", reference.error, reference.levels.size());
  return text + (reference.order ? format(", order %.2f)", *reference.order) : ", order not observed)");
}

std::string make_level_sentence(const Trade& trade, const TradeLevel& level) {
  const std::string name = percent_text(level.level) + ": ";
  if (level.cheapest >= 0) {
    const TradeResult& result = trade.results[static_cast<std::size_t>(level.cheapest)];
    return name + result.setting.label + format(" takes %.3g s a simulated second, error ", result.cost) +
           percent_text(result.error);
  }
  if (!level.decidable) return name + "cannot be told, the reference's own error is " + percent_text(trade.own_error());
  const TradeResult* best = nullptr;
  for (const TradeResult& result : trade.results)
    if (result.status == Status::done && (!best || result.error < best->error)) best = &result;
  if (!best) return name + "no setting reached it, none came to its end";
  return name + "no setting reached it, the closest is " + best->setting.label + " with " + percent_text(best->error);
}

std::string make_trade_text(const Trade& trade) {
  const std::size_t width = find_label_width(trade);
  std::string text = make_head(trade) + "\n";
  text += format("   %-*s %10s %10s %10s %10s %10s %10s %10s %5s\n", static_cast<int>(width), "setting", "h (s)",
                 "s per s", "of motion", "of scene", "most (m)", "energy", "volume", "runs");
  for (std::size_t group = 0; group < trade.groups.size(); ++group) {
    text += make_group_line(trade, group);
    for (const TradeResult& result : trade.results)
      if (result.setting.group == group) text += make_row(result, trade, width);
  }
  text += "\n* nothing measured is both faster and more accurate";
  if (std::ranges::any_of(trade.results, &TradeResult::at_limit)) text += "; ~ at the reference's limit";
  text += "\n";
  for (const TradeLevel& level : trade.levels) text += make_level_sentence(trade, level) + "\n";
  return text;
}

}  // namespace flexcast
