#include "core/lab/plot/plot_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace flexcast {
namespace {

constexpr double largest = 1e300;    // beyond it differences of values are no numbers
constexpr double least_span = 1e-9;  // of the values: less are differences that nobody could read
constexpr double room = 0.04;        // of the span, at both ends
const std::string minus = "\xE2\x88\x92", times = "\xC3\x97";

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

bool is_shown(double value, bool logarithmic) {
  return std::isfinite(value) && std::abs(value) <= largest && (value > 0.0 || !logarithmic);
}

std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, minus);
  return text;
}

std::string fixed_text(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return with_minus(text);
}

// 1, 2 or 5 times a power of ten, at least `raw`.
double calc_nice_step(double raw) {
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw * (1.0 - 1e-12)) return factor * power;
  return 10.0 * power;
}

// factor 10^exponent as people write it: 0.002, 20, or 2 x 10 to a power.
PlotTick make_power_label(int factor, int exponent, bool plain) {
  PlotTick tick;
  if (plain) {
    tick.text = fixed_text(factor * std::pow(10.0, exponent), std::max(0, -exponent));
  } else {
    tick.text = (factor == 1 ? "" : std::to_string(factor) + times) + "10";
    tick.power = with_minus(std::to_string(exponent));
  }
  return tick;
}

bool is_plain(double lo_exponent, double hi_exponent) {
  return lo_exponent >= -3.0 - 1e-9 && hi_exponent <= 4.0 + 1e-9;
}

}  // namespace

AxisScale::AxisScale(const PlotAxis& axis, const std::vector<double>& values) : logarithmic_(axis.logarithmic) {
  const auto measure = [&](double value) {
    return is_shown(value, logarithmic_) ? (logarithmic_ ? std::log10(value) : value) : nothing;
  };
  double lo = unbounded, hi = -unbounded;
  for (const double value : values) {
    lo = std::fmin(lo, measure(value));
    hi = std::fmax(hi, measure(value));
  }
  const double given_lo = measure(axis.lo.value_or(nothing)), given_hi = measure(axis.hi.value_or(nothing));
  if (lo > hi) {
    lo = !std::isnan(given_lo) ? given_lo : !std::isnan(given_hi) ? given_hi - 1.0 : 0.0;
    hi = lo + 1.0;
  }
  const bool from_zero = !logarithmic_ && lo >= 0.0;
  if (hi - lo <= least_span * std::max(std::abs(lo), std::abs(hi))) {
    const double middle = 0.5 * lo + 0.5 * hi;
    const double half = logarithmic_ ? 0.5 : middle != 0.0 ? 0.1 * std::abs(middle) : 1.0;
    lo = middle - half;
    hi = middle + half;
  }
  const double margin = room * (hi - lo);
  lo_ = !std::isnan(given_lo) ? given_lo : from_zero ? std::max(0.0, lo - margin) : lo - margin;
  hi_ = !std::isnan(given_hi) ? given_hi : hi + margin;
  if (!(hi_ - lo_ > least_span * std::max(std::abs(lo_), std::abs(hi_)))) {
    const double half = logarithmic_ || lo_ == 0.0 ? 1.0 : 0.1 * std::abs(lo_);
    hi_ = lo_ + half;
  }
}

std::optional<double> AxisScale::place(double value) const {
  if (!is_shown(value, logarithmic_)) return {};
  return calc_fraction(logarithmic_ ? std::log10(value) : value);
}

std::vector<PlotTick> AxisScale::make_ticks(int count) const {
  if (!logarithmic_) return make_linear_ticks(lo_, hi_, count);
  if (hi_ - lo_ >= 2.0) return make_decades(count);
  std::vector<PlotTick> ticks = make_decade_parts();
  return ticks.size() >= 3 ? ticks : make_linear_ticks(std::pow(10.0, lo_), std::pow(10.0, hi_), count);
}

std::vector<PlotTick> AxisScale::make_linear_ticks(double lo, double hi, int count) const {
  std::vector<PlotTick> ticks;
  const double step = calc_nice_step((hi - lo) / std::max(count, 1));
  if (!(step > 0.0)) return ticks;
  const double size = std::max(std::abs(lo), std::abs(hi));
  const int exponent = size < 1e-3 || size >= 1e6 ? static_cast<int>(std::floor(std::log10(size))) : 0;
  const int decimals = std::max(0, exponent - static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  for (double k = std::ceil(lo / step - 1e-9); k <= std::floor(hi / step + 1e-9); k += 1.0) {
    const double value = k * step;
    PlotTick tick{*place(value), fixed_text(value / std::pow(10.0, exponent), decimals), ""};
    if (k == 0.0) {
      tick.text = "0";
    } else if (exponent != 0) {
      tick.text += times + "10";
      tick.power = with_minus(std::to_string(exponent));
    }
    ticks.push_back(std::move(tick));
  }
  return ticks;
}

std::vector<PlotTick> AxisScale::make_decades(int count) const {
  std::vector<PlotTick> ticks;
  const int first = static_cast<int>(std::ceil(lo_ - 1e-9)), last = static_cast<int>(std::floor(hi_ + 1e-9));
  const int stride = (last - first) / std::max(count, 1) + 1;
  constexpr int most_lines = 40;
  for (int k = first; k <= last; ++k) {
    const bool labelled = k % stride == 0;
    if (!labelled && last - first > most_lines) continue;
    PlotTick tick = labelled ? make_power_label(1, k, is_plain(first, last)) : PlotTick{};
    tick.at = calc_fraction(k);
    ticks.push_back(std::move(tick));
  }
  return ticks;
}

std::vector<PlotTick> AxisScale::make_decade_parts() const {
  std::vector<PlotTick> ticks;
  for (int k = static_cast<int>(std::floor(lo_)); k <= static_cast<int>(std::floor(hi_)); ++k) {
    for (const int factor : {1, 2, 5}) {
      const double at = calc_fraction(k + std::log10(factor));
      if (at < -1e-9 || at > 1.0 + 1e-9) continue;
      PlotTick tick = make_power_label(factor, k, is_plain(std::floor(lo_), std::floor(hi_)));
      tick.at = at;
      ticks.push_back(std::move(tick));
    }
  }
  return ticks;
}

}  // namespace flexcast
