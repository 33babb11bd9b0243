// A state in which forces are timed: away from rest, and the same in every run and on every machine.
#pragma once

#include "core/forces/model.h"

namespace flexcast {

// Positions, m, 3 n. Bodies of tetrahedra are twisted by 0.3 rad/m about their longest side and bent by 0.5 rad/m over
// their shortest (less where they are so thick that strains would pass 20 %); every coordinate then moves by up to 2 %
// of the body's mean spacing, which is all that happens to springs.
VecX make_deformed_positions(const Model& model);

// Numbers spread over [-1, 1], always the same ones.
VecX make_scattered(std::int64_t count);

}  // namespace flexcast
