#include "core/base/range.h"

#include <cstdio>

namespace flexcast {
namespace {
std::string bound(const char* sign, double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%s %.12g", sign, value);
  return text;
}
}  // namespace

std::string Range::text() const {
  std::string low = std::isfinite(minimum) ? bound(minimum_open ? ">" : ">=", minimum) : "";
  std::string high = std::isfinite(maximum) ? bound(maximum_open ? "<" : "<=", maximum) : "";
  if (low.empty() && high.empty()) return "any finite number";
  if (low.empty()) return high;
  if (high.empty()) return low;
  return low + " and " + high;
}

}  // namespace flexcast
