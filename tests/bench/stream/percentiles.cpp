#include "tests/bench/stream/percentiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexcast::bench {

double calc_percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  const auto index = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(index, 1) - 1);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace flexcast::bench
