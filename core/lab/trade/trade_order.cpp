#include "core/lab/trade/trade_order.h"

#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

constexpr double agreement = 0.3, least_slope = 0.3;

double calc_slope(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::log(a[1] / b[1]) / std::log(a[0] / b[0]);
}

double fit_slope(const std::vector<std::array<double, 2>>& points, std::size_t first, std::size_t count) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    const double u = std::log(points[i][0] / points[first][0]), v = std::log(points[i][1] / points[first][1]);
    x += u, y += v, xx += u * u, xy += u * v;
  }
  const auto n = static_cast<double>(count);
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace

std::optional<ObservedOrder> calc_order(const std::vector<std::array<double, 2>>& points) {
  std::size_t best_first = 0, best_count = 0, first = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double slope = calc_slope(points[i - 1], points[i]);
    const bool falls = std::isfinite(slope) && slope >= least_slope;
    if (!falls) {
      first = i;
      continue;
    }
    const bool begins = i - first == 1;
    if (!begins && std::abs(slope - calc_slope(points[i - 2], points[i - 1])) > agreement) first = i - 1;
    const std::size_t count = i - first + 1;
    if (count >= 3 && count >= best_count) best_first = first, best_count = count;
  }
  if (best_count == 0) return std::nullopt;
  return ObservedOrder{fit_slope(points, best_first, best_count), static_cast<int>(best_count)};
}

std::optional<ObservedOrder> calc_order(const std::vector<TradeResult>& results, std::size_t group) {
  std::vector<std::array<double, 2>> points;
  for (const TradeResult& result : results) {
    const bool counts = result.setting.group == group && result.status == TradeResult::Status::done &&
                        !result.at_limit && result.error < 0.2 && result.error > 0.0 && result.h > 0.0;
    if (counts) points.push_back({result.h, result.error});
  }
  std::ranges::sort(points, std::greater<>(), [](const auto& point) { return point[0]; });
  return calc_order(points);
}

}  // namespace flexcast
