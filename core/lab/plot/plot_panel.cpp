#include "core/lab/plot/plot_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/lab/plot/plot_colors.h"
#include "core/lab/plot/plot_path.h"
#include "core/lab/plot/plot_text.h"

namespace flexcast {
namespace {

constexpr double tick_size = 12.0, axis_title_size = 13.0, mark_radius = 3.2;
constexpr double below_axis = 44.0;  // numbers and title of the x axis
constexpr double tick_width = 85.0, tick_height = 50.0;
constexpr double least_area = 0.45;  // of the panel's width; longer labels are cut
constexpr std::string_view grid_color = "#e8e8e8", axis_color = "#9a9a9a", text_color = "#444444";

std::vector<double> gather(const PlotPanel& panel, const PlotAxis PlotPanel::*other, std::size_t axis) {
  std::vector<double> values;
  for (const PlotSeries& series : panel.series) {
    for (const auto& point : series.points) {
      const double partner = point[1 - axis];
      // A point that is not shown says nothing about the range.
      if (std::isfinite(partner) && (partner > 0.0 || !(panel.*other).logarithmic)) values.push_back(point[axis]);
    }
  }
  return values;
}

std::string make_tip(const std::string& label, const std::array<double, 2>& point) {
  char text[80];
  std::snprintf(text, sizeof text, "%.6g, %.6g", point[0], point[1]);
  return label.empty() ? text : label + ": " + text;
}

double calc_above(const PlotPanel& panel) {
  return 10.0 + (panel.title.empty() ? 0.0 : 22.0) + (panel.y.title.empty() ? 0.0 : 20.0);
}

}  // namespace

PlotPanelDrawing::PlotPanelDrawing(const PlotPanel& panel)
    : panel_(panel),
      x_(panel.x, gather(panel, &PlotPanel::y, 0)),
      y_(panel.y, gather(panel, &PlotPanel::x, 1)),
      colors_(choose_colors(panel.series)) {}

double PlotPanelDrawing::calc_left() const {
  double width = 0.0;
  for (const PlotTick& tick : y_.make_ticks(6)) {
    width =
        std::max(width, estimate_text_width(tick.text, tick_size) + estimate_text_width(tick.power, 0.75 * tick_size));
  }
  return width + 14.0;
}

// The label of a line that ends at the fraction t of the area has what is right of it.
double PlotPanelDrawing::calc_right(double width, double left) const {
  double area = width - left - 16.0;
  for (const PlotSeries& series : panel_.series) {
    const auto end = find_label_point(series);
    const double t = end && !series.label.empty() ? x_.place((*end)[0]).value_or(0.0) : 0.0;
    if (t > 0.0) area = std::min(area, (width - left - 6.0 - calc_label_width(series)) / t);
  }
  return width - left - std::max(area, least_area * width);
}

void PlotPanelDrawing::draw(Svg& svg, SvgPoint corner, const PanelLayout& layout) const {
  const PlotArea area{{corner.x + layout.left, corner.y + calc_above(panel_), corner.x + layout.width - layout.right,
                       corner.y + layout.height - below_axis},
                      {corner.x, corner.y, corner.x + layout.width, corner.y + layout.height}};
  draw_axes(svg, area);
  draw_titles(svg, area);
  std::vector<SvgBox> taken;
  draw_slopes(svg, area, taken);
  for (std::size_t i = 0; i < panel_.series.size(); ++i) draw_series(svg, area, i);
  draw_labels(svg, area, taken);
  draw_notes(svg, area, taken);
}

void PlotPanelDrawing::draw_axes(Svg& svg, const PlotArea& area) const {
  const SvgBox& box = area.box;
  const SvgFont below{tick_size, text_color, SvgFont::Anchor::middle};
  const SvgFont beside{tick_size, text_color, SvgFont::Anchor::end};
  for (const PlotTick& tick : x_.make_ticks(static_cast<int>((box.right - box.left) / tick_width))) {
    const double x = area.at(tick.at, 0.0).x;
    svg.line({x, box.top}, {x, box.bottom}, {grid_color});
    if (!tick.text.empty()) svg.text({x, box.bottom + 17.0}, below, tick.text, tick.power);
  }
  for (const PlotTick& tick : y_.make_ticks(static_cast<int>((box.bottom - box.top) / tick_height))) {
    const double y = area.at(0.0, tick.at).y;
    svg.line({box.left, y}, {box.right, y}, {grid_color});
    if (!tick.text.empty()) svg.text({box.left - 8.0, y + 4.0}, beside, tick.text, tick.power);
  }
  svg.line({box.left, box.top}, {box.left, box.bottom}, {axis_color});
  svg.line({box.left, box.bottom}, {box.right, box.bottom}, {axis_color});
}

// The title of the y axis stands above it: nobody likes to read upwards.
void PlotPanelDrawing::draw_titles(Svg& svg, const PlotArea& area) const {
  const double left = area.panel.left, room = area.panel.right - left;
  if (!panel_.title.empty()) {
    const SvgFont font{14.0, "#222222", SvgFont::Anchor::start, true};
    svg.text({left, area.panel.top + 14.0}, font, fit_text(panel_.title, 15.0, room));
  }
  const SvgFont font{axis_title_size, text_color};
  if (!panel_.y.title.empty())
    svg.text({left, area.box.top - 11.0}, font, fit_text(panel_.y.title, axis_title_size, room));
  if (panel_.x.title.empty()) return;
  const SvgFont end{axis_title_size, text_color, SvgFont::Anchor::end};
  svg.text({area.box.right, area.box.bottom + 37.0}, end,
           fit_text(panel_.x.title, axis_title_size, area.box.right - left));
}

PlotPanelDrawing::Points PlotPanelDrawing::place(const PlotArea& area, const PlotSeries& series) const {
  Points points;
  points.reserve(series.points.size());
  for (const auto& [x, y] : series.points) {
    const auto right = x_.place(x), up = y_.place(y);
    points.push_back(right && up ? std::optional(area.at(*right, *up)) : std::nullopt);
  }
  return points;
}

void PlotPanelDrawing::draw_series(Svg& svg, const PlotArea& area, std::size_t number) const {
  const PlotSeries& series = panel_.series[number];
  const std::string_view color = plot_colors[static_cast<std::size_t>(colors_[number])].line;
  const Points points = place(area, series);
  const std::vector<PlotPiece> pieces = make_pieces(points);
  if (series.line) {
    svg.begin_clip(area.box);
    for (const PlotPiece& piece : pieces) svg.path(thin_out(piece), {color, 1.8, series.dashed});
    svg.end_clip();
  }
  // A point between gaps has no line; it is shown all the same.
  if (series.marks == PlotSeries::Marks::none) {
    for (const PlotPiece& piece : pieces) {
      if (piece.size() == 1 && area.contains(piece[0])) svg.circle(piece[0], 2.0, color, {color}, {});
    }
    return;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i] || !area.contains(*points[i])) continue;
    const std::string tip = make_tip(series.label, series.points[i]);
    if (series.marks == PlotSeries::Marks::crosses) {
      svg.cross(*points[i], 4.0, {color, 1.8}, tip);
    } else {
      svg.circle(*points[i], mark_radius, series.dashed ? "#ffffff" : color, {color, 1.2}, tip);
    }
  }
}

}  // namespace flexcast
