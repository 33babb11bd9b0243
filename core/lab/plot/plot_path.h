// Lines of a picture as pixels: pieces between gaps, and no more points than one can see.
#pragma once

#include <optional>
#include <vector>

#include "core/lab/plot/svg.h"

namespace flexcast {

using PlotPiece = std::vector<SvgPoint>;

// Runs of points without a gap.
std::vector<PlotPiece> make_pieces(const std::vector<std::optional<SvgPoint>>& points);

// Of neighbours in the same half pixel from left to right the first, the lowest, the highest and the last.
PlotPiece thin_out(const PlotPiece& piece);

}  // namespace flexcast
