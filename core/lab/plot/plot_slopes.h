// Where the line of a slope goes: beside the data that follow it most closely.
#pragma once

#include <utility>
#include <vector>

#include "core/lab/plot/plot_path.h"

namespace flexcast {

// From left to right. `slope` in pixels upwards per pixel to the right; `lines` in pixels.
std::pair<SvgPoint, SvgPoint> place_slope(const std::vector<PlotPiece>& lines, double slope, const SvgBox& area);

}  // namespace flexcast
