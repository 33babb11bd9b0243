#include "core/mesh/node_checks.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/mesh/offenders.h"

namespace flexcast {

Result<void> check_node_places(const std::string& file, const std::vector<Vec3>& nodes,
                               const std::function<std::string(std::size_t node)>& number) {
  Offenders not_finite;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].allFinite()) not_finite.add(number(i));
  }
  if (not_finite.any()) {
    return Error{file + ": coordinates that are not finite numbers: " + not_finite.text("node")};
  }

  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return std::tuple(nodes[i].x(), nodes[i].y(), nodes[i].z(), i); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  Offenders duplicates;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (nodes[order[i]] != nodes[order[i - 1]]) continue;
    duplicates.add(number(order[i]) + " (as " + number(order[i - 1]) + ")");
  }
  if (duplicates.any()) {
    return Error{file + ": nodes at the same place as another: " + duplicates.text("node")};
  }
  return {};
}

}  // namespace flexcast
