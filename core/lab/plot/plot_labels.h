// Where labels go so that they can be read: beside what they name, and not on top of each other.
#pragma once

#include <vector>

#include "core/lab/plot/svg.h"

namespace flexcast {

// Moves boxes up and down, as little as possible in the sense of least squares, until none overlaps another, and keeps
// them between top and bottom as far as there is room. Boxes side by side do not touch each other.
void spread_labels(std::vector<SvgBox>& boxes, double top, double bottom);

// The first place around a mark, near ones first, where a box of this size is free of all others and inside of the
// bounds; right above the mark if there is none.
SvgBox find_note_place(SvgPoint mark, double width, double height, const SvgBox& bounds,
                       const std::vector<SvgBox>& taken);

}  // namespace flexcast
