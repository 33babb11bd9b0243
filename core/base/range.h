// The interval of allowed values of a quantity: shared by scene reader, parameter table and their error texts.
#pragma once

#include <cmath>
#include <limits>
#include <string>

namespace flexcast {

struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_open = false;  // true: the bound itself is not allowed
  bool maximum_open = false;

  // NaN and infinities are never contained.
  bool contains(double value) const {
    return std::isfinite(value) && (minimum_open ? value > minimum : value >= minimum) &&
           (maximum_open ? value < maximum : value <= maximum);
  }

  // For people: "> 0", "> -1 and < 0.5", "any finite number".
  std::string text() const;
};

namespace ranges {
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Range any{};
inline constexpr Range positive{0.0, infinity, true, false};
inline constexpr Range non_negative{0.0, infinity, false, false};
inline constexpr Range poisson{-1.0, 0.5, true, true};
}  // namespace ranges

}  // namespace flexcast
