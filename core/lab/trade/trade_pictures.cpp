#include "core/lab/trade/trade_pictures.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "core/lab/trade/trade_report.h"

namespace flexcast {
namespace {

using Point = std::array<double, 2>;
using Status = TradeResult::Status;

// The last of the palette, black, for what is no group.
constexpr int neutral = 6;

// Where a failed setting is drawn: as an error of all of the motion and more.
constexpr double failed_error = 3.0, largest_error = 3.0;

std::string format_order(const char* pattern, double order) {
  char text[40];
  std::snprintf(text, sizeof text, pattern, order);
  return text;
}

bool is_drawn(const TradeResult& result) {
  return result.status == Status::done && result.error > 0.0;
}

Point at(const TradeResult& result, bool over_step) {
  return {over_step ? result.h : result.cost, std::min(result.error, largest_error)};
}

PlotSeries make_group_series(const Trade& trade, std::size_t group, bool over_step) {
  PlotSeries series;
  series.label = trade.groups[group].name;
  series.color = static_cast<int>(group) % neutral;
  for (const TradeResult& result : trade.results) {
    if (result.setting.group == group && is_drawn(result)) series.points.push_back(at(result, over_step));
  }
  // Labels stand at the last point: to the right of the lines.
  if (over_step) std::ranges::reverse(series.points);
  return series;
}

// A dashed level line from side to side.
PlotSeries make_line(const std::string& label, double error, double from, double to) {
  PlotSeries series;
  series.label = label;
  series.points = {{from, error}, {to, error}};
  series.dashed = true;
  series.color = neutral;
  series.marks = PlotSeries::Marks::none;
  return series;
}

// The smallest and the largest abscissa drawn.
Point find_range(const Trade& trade, bool over_step) {
  Point range = {std::numeric_limits<double>::infinity(), 0.0};
  for (const TradeResult& result : trade.results) {
    if (!is_drawn(result) || at(result, over_step)[0] <= 0.0) continue;
    range = {std::min(range[0], at(result, over_step)[0]), std::max(range[1], at(result, over_step)[0])};
  }
  return range[1] > 0.0 ? range : Point{0.1, 1.0};
}

void add_reference(const Trade& trade, bool over_step, PlotPanel& panel) {
  const auto [from, to] = find_range(trade, over_step);
  if (trade.own_error() > 0.0)
    panel.series.push_back(make_line("the reference's own error", trade.own_error(), from, to));
}

void add_levels(const Trade& trade, PlotPanel& panel) {
  const auto [from, to] = find_range(trade, false);
  for (const auto& [label, level] : {std::pair{"10 %", 0.1}, std::pair{"1 %", 0.01}, std::pair{"0.1 %", 0.001}})
    panel.series.push_back(make_line(label, level, from, to));
}

PlotSeries make_front(const Trade& trade) {
  PlotSeries front;
  front.color = neutral;
  front.label = "nothing is better";
  for (const TradeResult& result : trade.results)
    if (result.on_front && is_drawn(result)) front.points.push_back(at(result, false));
  std::ranges::sort(front.points);
  return front;
}

PlotSeries make_failed(const Trade& trade, std::size_t group) {
  PlotSeries failed;
  failed.line = false;
  failed.marks = PlotSeries::Marks::crosses;
  failed.color = static_cast<int>(group) % neutral;
  for (const TradeResult& result : trade.results) {
    if (result.setting.group != group || result.status != Status::failed || result.h <= 0.0) continue;
    failed.points.push_back({result.h, failed_error});
    failed.notes.push_back(trade.groups[group].name + " failed");
  }
  return failed;
}

std::string make_order_label(const Trade& trade, std::size_t group) {
  std::string label = trade.groups[group].name;
  if (trade.orders[group]) label += format_order(": %.2f", trade.orders[group]->order);
  const int theory = trade.groups[group].row->order;
  return theory > 0 && trade.orders[group] ? label + format_order(" (%.0f)", theory) : label;
}

}  // namespace

Plot make_trade_plot(const Trade& trade) {
  PlotPanel panel;
  panel.x = {"wall time per simulated second (s)", true};
  panel.y = {"error (fraction of the motion)", true};
  add_levels(trade, panel);
  add_reference(trade, false, panel);
  for (std::size_t i = 0; i < trade.groups.size(); ++i) {
    PlotSeries series = make_group_series(trade, i, false);
    if (!series.points.empty()) panel.series.push_back(std::move(series));
  }
  panel.series.push_back(make_front(trade));
  return {trade.scene + ": accuracy against time", make_reference_sentence(trade), {panel}};
}

Plot make_order_plot(const Trade& trade) {
  PlotPanel panel;
  panel.x = {"time step of the integrator (s)", true};
  panel.y = {"error (fraction of the motion)", true};
  add_reference(trade, true, panel);
  for (std::size_t i = 0; i < trade.groups.size(); ++i) {
    PlotSeries series = make_group_series(trade, i, true);
    series.label = make_order_label(trade, i);
    if (!series.points.empty() && !trade.groups[i].tolerance) panel.series.push_back(std::move(series));
  }
  for (std::size_t i = 0; i < trade.groups.size(); ++i) {
    PlotSeries failed = make_failed(trade, i);
    if (!failed.points.empty()) panel.series.push_back(std::move(failed));
  }
  panel.slopes = {{1.0, "order 1"}, {2.0, "order 2"}, {4.0, "order 4"}};
  return {
      trade.scene + ": error against time step, order observed (by theory)", make_reference_sentence(trade), {panel}};
}

}  // namespace flexcast
