#include "core/integrators/coloring.h"

#include <algorithm>

namespace flexcast {

std::vector<std::vector<std::int32_t>> make_colors(std::int32_t particles, Couplings couplings) {
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

VisitOrder::VisitOrder(std::int32_t particles, Couplings couplings) {
  constexpr std::size_t stretch = 1024, run = Visits::most_in_run;
  std::vector<std::int32_t> counts(static_cast<std::size_t>(particles), 0);
  for (const auto& [i, j] : couplings) ++counts[static_cast<std::size_t>(i)], ++counts[static_cast<std::size_t>(j)];
  visits.particles.reserve(static_cast<std::size_t>(particles));
  visits.starts.push_back(0);
  color_starts.push_back(0);
  for (std::vector<std::int32_t>& color : make_colors(particles, std::move(couplings))) {
    for (std::size_t first = 0; first < color.size(); first += stretch) {
      const auto begin = color.begin() + static_cast<std::ptrdiff_t>(first);
      const auto end = color.begin() + static_cast<std::ptrdiff_t>(std::min(color.size(), first + stretch));
      std::stable_sort(begin, end, [&](std::int32_t a, std::int32_t b) {
        return counts[static_cast<std::size_t>(a)] > counts[static_cast<std::size_t>(b)];
      });
    }
    const std::size_t start = visits.particles.size();
    visits.particles.insert(visits.particles.end(), color.begin(), color.end());
    for (std::size_t end = start; end < visits.particles.size();) {
      end = std::min(visits.particles.size(), end + run);
      visits.starts.push_back(static_cast<std::int32_t>(end));
    }
    color_starts.push_back(visits.run_count());
  }
}

}  // namespace flexcast
