#include "core/integrators/stability.h"

#include <limits>

namespace flexcast {

double find_stability_limit(double scale, const std::function<double(double)>& spectral_radius) {
  if (!(scale > 0.0)) return 0.0;  // a mode faster than any number
  const auto stable = [&](double s) { return spectral_radius(s) <= 1.0 + 1e-10; };
  double low = 0.0, high = scale;
  while (stable(high)) {
    low = high;
    high *= 1.01;
    if (high > 1e6 * scale) return std::numeric_limits<double>::infinity();
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return low * (1.0 - 1e-9);
}

}  // namespace flexcast
