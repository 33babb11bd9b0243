// Stability limits by search, for schemes without a handy closed form.
#pragma once

#include <functional>

namespace flexcast {

// The smallest s > 0 at which spectral_radius(s) passes 1, a hair (1e-9) below it; `scale` is a value of s well below
// it and 1e6 * scale counts as infinite. 0 where scale is no positive number.
double find_stability_limit(double scale, const std::function<double(double)>& spectral_radius);

}  // namespace flexcast
