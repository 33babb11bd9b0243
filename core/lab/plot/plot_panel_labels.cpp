// What is written into a panel: labels at the ends of lines, notes beside points, slopes with their names.
#include <algorithm>
#include <cmath>

#include "core/lab/plot/plot_colors.h"
#include "core/lab/plot/plot_labels.h"
#include "core/lab/plot/plot_panel.h"
#include "core/lab/plot/plot_slopes.h"
#include "core/lab/plot/plot_text.h"

namespace flexcast {
namespace {

constexpr double label_size = 13.0, note_size = 11.0, label_height = 16.0, label_gap = 9.0;

}  // namespace

double PlotPanelDrawing::calc_label_width(const PlotSeries& series) {
  return label_gap + estimate_text_width(series.label, label_size);
}

std::optional<std::array<double, 2>> PlotPanelDrawing::find_label_point(const PlotSeries& series) const {
  for (auto point = series.points.rbegin(); point != series.points.rend(); ++point)
    if (x_.place((*point)[0]) && y_.place((*point)[1])) return *point;
  return {};
}

void PlotPanelDrawing::draw_labels(Svg& svg, const PlotArea& area, std::vector<SvgBox>& taken) const {
  std::vector<SvgBox> boxes;
  std::vector<std::size_t> owners;
  std::vector<SvgPoint> ends;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < panel_.series.size(); ++i) {
    const PlotSeries& series = panel_.series[i];
    const auto point = find_label_point(series);
    if (!point || series.label.empty()) continue;
    SvgPoint end = area.at(*x_.place((*point)[0]), *y_.place((*point)[1]));
    end.x = std::clamp(end.x, area.box.left, area.box.right);
    end.y = std::clamp(end.y, area.box.top, area.box.bottom);
    const double left = end.x + label_gap;
    texts.push_back(fit_text(series.label, label_size, area.panel.right - left));
    boxes.push_back({left, end.y - 0.5 * label_height, left + estimate_text_width(texts.back(), label_size),
                     end.y + 0.5 * label_height});
    owners.push_back(i);
    ends.push_back(end);
  }
  spread_labels(boxes, area.box.top - 0.5 * label_height, area.box.bottom + 2.0);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const PlotColor& color = plot_colors[static_cast<std::size_t>(colors_[owners[k]])];
    const double middle = boxes[k].top + 0.5 * label_height;
    // A label that had to move far is led back to its line.
    if (std::abs(middle - ends[k].y) > 0.6 * label_height)
      svg.line({ends[k].x + 2.0, ends[k].y}, {boxes[k].left - 1.0, middle}, {color.line, 0.7});
    const SvgFont font{label_size, color.text, SvgFont::Anchor::start, false, true};
    svg.text({boxes[k].left, middle + 4.5}, font, texts[k]);
  }
  taken.insert(taken.end(), boxes.begin(), boxes.end());
}

void PlotPanelDrawing::draw_slopes(Svg& svg, const PlotArea& area, std::vector<SvgBox>& taken) const {
  std::vector<PlotPiece> lines;
  for (const PlotSeries& series : panel_.series) {
    PlotPiece all;
    for (const auto& point : place(area, series))
      if (point) all.push_back(*point);
    if (series.line) lines.push_back(std::move(all));
  }
  const double unit = (area.box.bottom - area.box.top) / y_.span() * x_.span() / (area.box.right - area.box.left);
  for (const PlotSlope& slope : panel_.slopes) {
    const auto [from, to] = place_slope(lines, slope.slope * unit, area.box);
    svg.begin_clip(area.box);
    svg.line(from, to, {"#9a9a9a", 1.2});
    svg.end_clip();
    const double width = estimate_text_width(slope.label, note_size + 1.0);
    // On the side of the line that the data are not on.
    const double top = slope.slope < 0.0 ? to.y - 18.0 : to.y + 4.0;
    const SvgPoint corner{std::clamp(to.x, area.box.left, std::max(area.box.left, area.box.right - width)),
                          std::clamp(top, area.box.top, area.box.bottom - 14.0)};
    const SvgBox box{corner.x, corner.y, corner.x + width, corner.y + 14.0};
    svg.text({box.left, box.top + 11.0}, {note_size + 1.0, "#6e6e6e", SvgFont::Anchor::start, false, true},
             slope.label);
    taken.push_back(box);
  }
}

void PlotPanelDrawing::draw_notes(Svg& svg, const PlotArea& area, std::vector<SvgBox>& taken) const {
  std::vector<std::vector<std::optional<SvgPoint>>> places;
  for (const PlotSeries& series : panel_.series) {
    places.push_back(place(area, series));
    if (series.marks == PlotSeries::Marks::none) continue;
    for (const auto& point : places.back())
      if (point) taken.push_back({point->x - 4.0, point->y - 4.0, point->x + 4.0, point->y + 4.0});
  }
  for (std::size_t i = 0; i < panel_.series.size(); ++i) {
    const PlotSeries& series = panel_.series[i];
    const SvgFont font{note_size, plot_colors[static_cast<std::size_t>(colors_[i])].text, SvgFont::Anchor::start, false,
                       true};
    for (std::size_t k = 0; k < std::min(series.notes.size(), places[i].size()); ++k) {
      if (series.notes[k].empty() || !places[i][k] || !area.contains(*places[i][k])) continue;
      const double width = estimate_text_width(series.notes[k], note_size);
      const SvgBox box = find_note_place(*places[i][k], width, 13.0, area.panel, taken);
      svg.text({box.left, box.top + 10.0}, font, series.notes[k]);
      taken.push_back(box);
    }
  }
}

}  // namespace flexcast
