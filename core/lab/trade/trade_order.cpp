#include "core/lab/trade/trade_order.h"

#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

constexpr double slope_agreement = 0.2, least_slope = 0.3;

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
  for (std::size_t last = points.size(); last-- > 2;) {
    const double finest = calc_slope(points[last - 1], points[last]);
    if (!std::isfinite(finest) || finest < least_slope) continue;
    std::size_t first = last - 1;
    while (first > 0 && std::abs(calc_slope(points[first - 1], points[first]) - finest) <= slope_agreement) --first;
    const std::size_t count = last - first + 1;
    if (count >= 3) return ObservedOrder{fit_slope(points, first, count), static_cast<int>(count)};
  }
  return std::nullopt;
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
