#include "core/lab/plot/plot_slopes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace flexcast {
namespace {

constexpr double gap = 16.0;  // pixels between the line and the data

struct Fit {
  SvgPoint center;
  double slope = 0.0;  // upwards
  double left = 0.0, right = 0.0;
};

// Least squares; nothing for fewer than two places.
std::optional<Fit> calc_fit(const PlotPiece& line) {
  if (line.empty()) return {};
  Fit fit{{}, 0.0, line[0].x, line[0].x};
  for (const SvgPoint& point : line) {
    fit.center.x += point.x / static_cast<double>(line.size());
    fit.center.y += point.y / static_cast<double>(line.size());
    fit.left = std::min(fit.left, point.x);
    fit.right = std::max(fit.right, point.x);
  }
  double xx = 0.0, xy = 0.0;
  for (const SvgPoint& point : line) {
    xx += (point.x - fit.center.x) * (point.x - fit.center.x);
    xy += (point.x - fit.center.x) * (fit.center.y - point.y);
  }
  if (!(xx > 0.0)) return {};
  fit.slope = xy / xx;
  return fit;
}

}  // namespace

std::pair<SvgPoint, SvgPoint> place_slope(const std::vector<PlotPiece>& lines, double slope, const SvgBox& area) {
  const double width = area.right - area.left;
  Fit best{{0.5 * (area.left + area.right), 0.5 * (area.top + area.bottom)}, slope, area.left, area.right};
  double least = 1e300;
  for (const PlotPiece& line : lines) {
    const auto fit = calc_fit(line);
    if (!fit || std::abs(std::atan(fit->slope) - std::atan(slope)) >= least) continue;
    least = std::abs(std::atan(fit->slope) - std::atan(slope));
    best = *fit;
  }
  const double half = std::clamp(0.2 * (best.right - best.left), 0.05 * width, 0.2 * width);
  // Below a rising line, above a falling one, both times on its right.
  const double length = std::hypot(1.0, slope), side = slope < 0.0 ? -1.0 : 1.0;
  const SvgPoint middle{best.center.x + side * gap * slope / length, best.center.y + side * gap / length};
  return {{middle.x - half, middle.y + half * slope}, {middle.x + half, middle.y - half * slope}};
}

}  // namespace flexcast
