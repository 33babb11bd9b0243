#include "core/lab/plot/plot_path.h"

#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

// Appends what is seen of piece[first .. last).
void add_column(const PlotPiece& piece, std::size_t first, std::size_t last, PlotPiece& thin) {
  std::size_t low = first, high = first;
  for (std::size_t i = first; i < last; ++i) {
    if (piece[i].y < piece[low].y) low = i;
    if (piece[i].y > piece[high].y) high = i;
  }
  std::vector<std::size_t> kept = {first, low, high, last - 1};
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  for (const std::size_t i : kept) thin.push_back(piece[i]);
}

}  // namespace

std::vector<PlotPiece> make_pieces(const std::vector<std::optional<SvgPoint>>& points) {
  std::vector<PlotPiece> pieces;
  bool open = false;
  for (const auto& point : points) {
    if (point && !open) pieces.emplace_back();
    if (point) pieces.back().push_back(*point);
    open = point.has_value();
  }
  return pieces;
}

PlotPiece thin_out(const PlotPiece& piece) {
  const auto column = [&](std::size_t i) { return std::floor(2.0 * piece[i].x); };
  PlotPiece thin;
  for (std::size_t first = 0, last = 0; first < piece.size(); first = last) {
    while (last < piece.size() && column(last) == column(first)) ++last;
    add_column(piece, first, last, thin);
  }
  return thin;
}

}  // namespace flexcast
