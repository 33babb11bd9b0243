// Percentiles of what was measured.
#pragma once

#include <vector>

namespace flexcast::bench {

// The value that `fraction` (0..1) of the values do not exceed; 0 of none.
double calc_percentile(std::vector<double> values, double fraction);

}  // namespace flexcast::bench
