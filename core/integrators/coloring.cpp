#include "core/integrators/coloring.h"

#include <algorithm>

namespace flexcast {

std::vector<std::vector<std::int32_t>> make_colors(std::int32_t particles,
                                                   std::vector<std::pair<std::int32_t, std::int32_t>> couplings) {
  // Only neighbours with smaller numbers have a colour when a particle's turn comes.
  for (auto& [i, j] : couplings) {
    if (i < j) std::swap(i, j);
  }
  std::sort(couplings.begin(), couplings.end());
  std::vector<std::int32_t> color_of(static_cast<std::size_t>(particles), 0);
  std::vector<std::vector<std::int32_t>> colors;
  std::vector<std::uint8_t> taken;
  std::size_t next = 0;
  for (std::int32_t i = 0; i < particles; ++i) {
    taken.assign(colors.size() + 1, 0);
    for (; next < couplings.size() && couplings[next].first == i; ++next) {
      if (couplings[next].second < i) taken[static_cast<std::size_t>(color_of[couplings[next].second])] = 1;
    }
    const auto color = std::find(taken.begin(), taken.end(), 0) - taken.begin();
    color_of[i] = static_cast<std::int32_t>(color);
    if (static_cast<std::size_t>(color) == colors.size()) colors.emplace_back();
    colors[static_cast<std::size_t>(color)].push_back(i);
  }
  return colors;
}

}  // namespace flexcast
