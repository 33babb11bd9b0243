// An axis of a picture: its range, where values lie on it, its ticks.
#pragma once

#include <string>
#include <vector>

#include "core/lab/plot/plot.h"

namespace flexcast {

struct PlotTick {
  double at = 0.0;    // along the axis: 0 at its start, 1 at its end
  std::string text;   // "": a line without number
  std::string power;  // raised behind the text: the exponent of "10"
};

class AxisScale {
 public:
  // Covers the values that can be shown, with a little room, unless the axis has limits of its own.
  AxisScale(const PlotAxis& axis, const std::vector<double>& values);

  // Along the axis, perhaps outside of [0, 1]; nothing for what cannot be shown.
  std::optional<double> place(double value) const;

  // About `count` ticks with numbers: 1, 2, 5 times a power of ten; decades on a logarithmic axis.
  std::vector<PlotTick> make_ticks(int count) const;

  // How much of the scale's own measure (decades on a logarithmic axis) the axis covers.
  double span() const { return hi_ - lo_; }

 private:
  std::vector<PlotTick> make_linear_ticks(double lo, double hi, int count) const;
  std::vector<PlotTick> make_decades(int count) const;
  std::vector<PlotTick> make_decade_parts() const;
  double calc_fraction(double measure) const { return (measure - lo_) / (hi_ - lo_); }

  bool logarithmic_;
  double lo_ = 0.0, hi_ = 1.0;  // values, or their decimal logarithms
};

}  // namespace flexcast
