// Pictures of measurements as SVG: lines with labels at their ends, on a light background, in colours that the
// colour-blind tell apart (M. Okabe, K. Ito, Color Universal Design, 2008).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace flexcast {

struct PlotAxis {
  std::string title;  // with the unit: "time step (s)"
  bool logarithmic = false;
  std::optional<double> lo = {}, hi = {};  // default: what the data need
};

struct PlotSeries {
  enum class Marks { none, dots, crosses };   // crosses: what failed
  std::string label;                          // at the last point; "" shows none
  std::vector<std::array<double, 2>> points;  // not finite, or <= 0 on a logarithmic axis: a gap in the line
  bool line = true;
  bool dashed = false;  // predictions, references
  Marks marks = Marks::dots;
  int color = -1;  // number in the palette; -1: the next; series of one thing share a number
  // Beside single points; as many as points, or none.
  std::vector<std::string> notes = {};
};

// A straight line of the given slope in a doubly logarithmic panel, with its name: what an order looks like.
struct PlotSlope {
  double slope = 1.0;
  std::string label;
};

struct PlotPanel {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::vector<PlotSlope> slopes = {};
};

struct Plot {
  std::string title;
  std::string subtitle;  // what was measured, on what; may be empty
  std::vector<PlotPanel> panels;
  int columns = 1;
};

// Text is escaped; labels that would overlap are moved apart. The same plot gives the same bytes.
std::string make_svg(const Plot& plot);

}  // namespace flexcast
