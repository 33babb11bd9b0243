// The fastest and the most damped mode of a scene at a state, for the stability limit of explicit schemes.
#pragma once

#include <vector>

#include "core/forces/system.h"

namespace flexcast {

// Lanczos iteration on M^-1 K and M^-1 D of each body, K and D by the forces themselves (differences, no matrices). An
// iteration approaches the largest eigenvalue from below, so the residual of the Ritz pair is added; the bounds of the
// elements, which no mode passes at rest, cap the result where they hold.
// Source: B. N. Parlett, The Symmetric Eigenvalue Problem, SIAM 1998, chapter 13.
// One per body, of all active forces.
std::vector<ModeBound> calc_largest_modes(const System& system, const Model& model, const VecX& x);

}  // namespace flexcast
