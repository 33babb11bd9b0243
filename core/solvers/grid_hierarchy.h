// Background grids for multigrid: a regular lattice around every connected piece of a matrix's graph, about twice as
// wide as the particles' spacing, then twice as wide again and again, until few nodes are left. Values are interpolated
// trilinearly at the rest positions, so that translations and linear deformations pass from level to level unchanged.
// Nodes that no particle refers to do not exist.
// Source: U. Trottenberg, C. Oosterlee, A. Schueller, Multigrid, Academic Press
// 2001, chapters 2 and 8.
#pragma once

#include <vector>

#include "core/base/block_matrix.h"
#include "core/solvers/interpolation.h"

namespace flexcast {

struct GridHierarchy {
  std::vector<Interpolation> levels;       // from the particles to the first grid, from there to the second, ...
  std::vector<std::int32_t> piece_starts;  // pieces + 1: whose nodes of the last grid are whose
};

// Pieces of at most `largest_piece` nodes are not made any coarser. Particles without couplings are on no grid.
GridHierarchy make_grid_hierarchy(const BlockMatrix& A, const VecX& rest_positions, std::int32_t largest_piece);

}  // namespace flexcast
