// The loops over the numbers of a frame, over plain arrays; the same bits with every instruction set.
#pragma once

#include <cstdint>

namespace flexcast {

// Both round to the nearest, as static_cast does. Arrays do not overlap.
void convert_to_floats(const double* numbers, std::int64_t count, float* floats);

// Widens the box low[3], high[3] (m; finite or infinite) so that it holds the positions x0, y0, z0, x1, ...; `count` is
// a multiple of 3. A bound that is zero comes out as +0, whatever the signs of the zeros that were met.
void widen_bounds(const double* positions, std::int64_t count, double* low, double* high);

// Nearest q of x = low + q / 65535 (high - low), by axis; 0 where high = low. The fraction is in [0, 1] even where the
// extent is too small for a reciprocal. `count` is a multiple of 3, the box holds the positions.
void quantize(const double* positions, std::int64_t count, const double* low, const double* high,
              std::uint16_t* fractions);

}  // namespace flexcast
