// The colours of lines (M. Okabe, K. Ito, Color Universal Design, 2008) without the yellow that white swallows.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "core/lab/plot/plot.h"

namespace flexcast {

struct PlotColor {
  std::string_view line;
  std::string_view text;  // the same, dark enough to be read on white
};

inline constexpr std::array<PlotColor, 7> plot_colors{{{"#0072b2", "#0072b2"},
                                                       {"#d55e00", "#b84f00"},
                                                       {"#009e73", "#007a59"},
                                                       {"#cc79a7", "#a84f80"},
                                                       {"#e69f00", "#946600"},
                                                       {"#56b4e9", "#1f7fb5"},
                                                       {"#000000", "#000000"}}};

// Number in the palette of every series: its own, or one more than those before it.
inline std::vector<int> choose_colors(const std::vector<PlotSeries>& series) {
  std::vector<int> colors;
  int next = 0;
  for (const PlotSeries& one : series) {
    const int color = one.color >= 0 ? one.color : next;
    next = std::max(next, color + 1);
    colors.push_back(color % static_cast<int>(plot_colors.size()));
  }
  return colors;
}

}  // namespace flexcast
