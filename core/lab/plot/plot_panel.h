// One panel of a picture: axes, lines, marks and their labels.
#pragma once

#include "core/lab/plot/plot.h"
#include "core/lab/plot/plot_axis.h"
#include "core/lab/plot/svg.h"

namespace flexcast {

// What the panels of a picture share, pixels.
struct PanelLayout {
  double width = 860.0;   // of the whole panel
  double height = 480.0;  // of the whole panel
  double left = 60.0;     // from the panel to its axis: numbers of ticks
  double right = 20.0;    // from the area of the data to the end of the panel: labels of lines
};

// Where the data are, pixels.
struct PlotArea {
  SvgBox box;
  SvgBox panel;

  SvgPoint at(double x, double y) const {
    return {box.left + x * (box.right - box.left), box.bottom - y * (box.bottom - box.top)};
  }
  bool contains(SvgPoint point) const {
    constexpr double slack = 0.5;
    return point.x >= box.left - slack && point.x <= box.right + slack && point.y >= box.top - slack &&
           point.y <= box.bottom + slack;
  }
};

class PlotPanelDrawing {
 public:
  // Keeps a reference to the panel.
  explicit PlotPanelDrawing(const PlotPanel& panel);

  // What this panel needs left and right of its data, given its width.
  double calc_left() const;
  double calc_right(double width, double left) const;

  void draw(Svg& svg, SvgPoint corner, const PanelLayout& layout) const;

 private:
  using Points = std::vector<std::optional<SvgPoint>>;  // nothing: a gap

  void draw_axes(Svg& svg, const PlotArea& area) const;
  void draw_titles(Svg& svg, const PlotArea& area) const;
  void draw_series(Svg& svg, const PlotArea& area, std::size_t number) const;
  void draw_slopes(Svg& svg, const PlotArea& area, std::vector<SvgBox>& taken) const;
  void draw_labels(Svg& svg, const PlotArea& area, std::vector<SvgBox>& taken) const;
  void draw_notes(Svg& svg, const PlotArea& area, std::vector<SvgBox>& taken) const;
  static double calc_label_width(const PlotSeries& series);  // with the gap before it
  Points place(const PlotArea& area, const PlotSeries& series) const;
  std::optional<std::array<double, 2>> find_label_point(const PlotSeries& series) const;

  const PlotPanel& panel_;
  AxisScale x_, y_;
  std::vector<int> colors_;  // one a series
};

}  // namespace flexcast
