#include "core/lab/limits/limits_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/lab/output_file.h"

namespace flexcast {
namespace {

using Json = nlohmann::ordered_json;

struct Extreme {
  double ratio = 0.0;
  std::string where;
};

struct Extremes {
  std::optional<Extreme> least, largest;
};

std::string short_text(const char* format, double value) {
  char text[60];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

Extremes find_extremes(const Limits& limits) {
  Extremes found;
  for (const LimitPanel& panel : limits.panels) {
    for (const LimitCurve& curve : panel.curves) {
      for (const LimitPoint& point : curve.points) {
        const auto ratio = point.calc_ratio();
        if (!ratio) continue;
        const Extreme one{*ratio,
                          curve.integrator + ", " + panel.variation.name + " " + short_text("%.4g", point.value)};
        if (!found.least || one.ratio < found.least->ratio) found.least = one;
        if (!found.largest || one.ratio > found.largest->ratio) found.largest = one;
      }
    }
  }
  return found;
}

std::string make_extremes_text(const Extreme& least, const Extreme& largest) {
  const std::string from = short_text("%.4f", least.ratio), to = short_text("%.4f", largest.ratio);
  const bool agree = from == to && least.ratio >= 1.0;
  return "measured over predicted: " +
         (agree ? from + " everywhere"
                : "from " + from + " (" + least.where + ") to " + to + " (" + largest.where + ")") +
         "; at a step 1 % longer than the measured one growth was seen\n";
}

std::string cell_text(const LimitPoint& point) {
  if (!point.limit.measured) return "no limit";
  if (*point.limit.measured == 0.0) return "never stable";
  if (!point.limit.resolved) return "< " + short_text("%.3e s", *point.limit.measured);
  const auto ratio = point.calc_ratio();
  return short_text("%.3e s", *point.limit.measured) + (ratio ? short_text("  x%.3f", *ratio) : "");
}

const LimitPoint* find_point(const LimitCurve& curve, double value) {
  for (const LimitPoint& point : curve.points)
    if (point.value == value) return &point;
  return nullptr;
}

void add_row(std::string& text, const std::string& first, const std::vector<std::string>& cells) {
  char cell[80];
  std::snprintf(cell, sizeof cell, "  %-10s", first.c_str());
  text += cell;
  for (const std::string& content : cells) {
    std::snprintf(cell, sizeof cell, "  %-20s", content.c_str());
    text += cell;
  }
  text.erase(text.find_last_not_of(' ') + 1);
  text += '\n';
}

std::string make_sentence(const LimitPanel& panel, const LimitCurve& curve) {
  const auto power = calc_power(panel.variation, curve);
  if (!power) return "";
  const std::string start = curve.integrator + ": the largest stable step goes as " + panel.variation.measure + "^";
  const std::string first = short_text("%.2f", power->first), last = short_text("%.2f", power->last);
  const bool one = std::abs(power->first - power->last) < 0.05;
  return "  " + start +
         (one ? short_text("%.2f", 0.5 * (power->first + power->last))
              : first + " at the first values and ^" + last + " at the last") +
         "\n";
}

std::string make_panel_text(const LimitPanel& panel) {
  std::string text = panel.variation.title + ": largest stable step, x measured over predicted\n";
  bool resolved = true;
  std::vector<std::string> cells;
  for (const LimitCurve& curve : panel.curves) cells.push_back(curve.integrator);
  add_row(text, "", cells);
  for (const double value : panel.variation.values) {
    cells.clear();
    for (const LimitCurve& curve : panel.curves) {
      const LimitPoint* point = find_point(curve, value);
      cells.push_back(point ? cell_text(*point) : "-");
      resolved = resolved && (!point || point->limit.resolved);
    }
    add_row(text, short_text("%.4g", value), cells);
  }
  if (!resolved) text += "  <: growth too slow to be seen in the steps taken; the limit lies somewhere below\n";
  for (const LimitCurve& curve : panel.curves) text += make_sentence(panel, curve);
  return text + "\n";
}

std::string make_implicit_text(const Limits& limits) {
  if (limits.runs.empty()) return "";
  std::string text = "implicit schemes, 100 steps: largest energy norm over the first\n";
  for (const BoundedRun& run : limits.runs) {
    add_row(text, short_text("%.4g s", run.step),
            {run.integrator, short_text("%.3g", run.gain), run.bounded() ? "bounded" : "BLOWS UP"});
  }
  return text + "\n";
}

std::string number_cell(const std::optional<double>& value) {
  return value ? exact_text(*value) : "";
}

Json number_json(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json make_curve_json(const LimitPanel& panel, const LimitCurve& curve) {
  const auto power = calc_power(panel.variation, curve);
  Json json{{"integrator", curve.integrator}, {"power", nullptr}, {"points", Json::array()}};
  if (power) json["power"] = {power->first, power->last};
  for (const LimitPoint& point : curve.points) {
    json["points"].push_back({{"value", point.value},
                              {"measured", number_json(point.limit.measured)},
                              {"predicted", number_json(point.limit.predicted)},
                              {"ratio", number_json(point.calc_ratio())},
                              {"resolved", point.limit.resolved}});
  }
  return json;
}

}  // namespace

std::optional<LimitPower> calc_power(const Variation& variation, const LimitCurve& curve) {
  std::vector<std::array<double, 2>> logs;
  for (const LimitPoint& point : curve.points) {
    const double measure = variation.calc_measure(point.value);
    if (measure > 0.0 && point.limit.resolved && point.limit.measured.value_or(0.0) > 0.0)
      logs.push_back({std::log(measure), std::log(*point.limit.measured)});
  }
  if (logs.size() < 2) return {};
  const auto calc_slope = [&](std::size_t i) { return (logs[i + 1][1] - logs[i][1]) / (logs[i + 1][0] - logs[i][0]); };
  return LimitPower{calc_slope(0), calc_slope(logs.size() - 2)};
}

std::string make_limits_text(const Limits& limits) {
  std::string text;
  const auto is_empty = [](const LimitCurve& curve) { return curve.points.empty(); };
  for (const LimitPanel& panel : limits.panels)
    if (!std::all_of(panel.curves.begin(), panel.curves.end(), is_empty)) text += make_panel_text(panel);
  text += make_implicit_text(limits);
  const Extremes extremes = find_extremes(limits);
  if (!extremes.least) return text;
  text += make_extremes_text(*extremes.least, *extremes.largest);
  if (extremes.least->ratio < 1.0) text += "The advertised limit is above the true one there: a bug of the engine.\n";
  return text;
}

std::string make_limits_csv(const Limits& limits) {
  std::string text = "quantity,value,integrator,measured,predicted,ratio,resolved\n";
  for (const LimitPanel& panel : limits.panels) {
    for (const LimitCurve& curve : panel.curves) {
      for (const LimitPoint& point : curve.points) {
        text += panel.variation.name + ',' + exact_text(point.value) + ',' + curve.integrator + ',' +
                number_cell(point.limit.measured) + ',' + number_cell(point.limit.predicted) + ',' +
                number_cell(point.calc_ratio()) + (point.limit.resolved ? ",1\n" : ",0\n");
      }
    }
  }
  return text;
}

nlohmann::ordered_json make_limits_json(const Limits& limits) {
  const Extremes extremes = find_extremes(limits);
  const auto extreme_json = [](const std::optional<Extreme>& extreme) {
    return extreme ? Json{{"ratio", extreme->ratio}, {"where", extreme->where}} : Json(nullptr);
  };
  Json json{{"scene", limits.scene},
            {"quantities", Json::array()},
            {"implicit", Json::array()},
            {"least", extreme_json(extremes.least)},
            {"largest", extreme_json(extremes.largest)},
            {"notes", limits.notes}};
  for (const LimitPanel& panel : limits.panels) {
    Json curves = Json::array();
    for (const LimitCurve& curve : panel.curves) curves.push_back(make_curve_json(panel, curve));
    json["quantities"].push_back(
        {{"name", panel.variation.name}, {"title", panel.variation.title}, {"curves", std::move(curves)}});
  }
  for (const BoundedRun& run : limits.runs) {
    json["implicit"].push_back({{"integrator", run.integrator},
                                {"step", run.step},
                                {"gain", number_json(run.gain)},
                                {"bounded", run.bounded()}});
  }
  return json;
}

}  // namespace flexcast
