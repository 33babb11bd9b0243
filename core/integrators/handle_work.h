// The handles' part of the books. A pass over the particles leaves the velocities of handles as they were; the forces F
// on their particles work along them all the same, and handles put in what it takes to move as prescribed.
#pragma once

#include "core/forces/system.h"

namespace flexcast {

// W: F . v over the particles of handles.
double calc_handle_power(const System& system, const VecX& F, const VecX& v);

// Puts the handles' particles where they are at `time` and books the change of their velocities from v0, found in v, to
// v1, with an impulse h F acting meanwhile: handles put in (v0 + v1)/2 . (m (v1 - v0) - h F), and forces, whose work
// along v0 the books have, add h F . (v1 - v0)/2.
void move_handles(const System& system, double time, double h, const VecX& F, VecX& x, VecX& v,
                  StepStatistics& statistics);

}  // namespace flexcast
