// A_c = P^T A P, the matrix of a coarser grid: pattern and maps once, values as often as A changes.
#pragma once

#include <vector>

#include "core/base/block_matrix.h"
#include "core/solvers/interpolation.h"

namespace flexcast {

class GalerkinProduct {
 public:
  // Both must stay as they are; the pattern of A too.
  GalerkinProduct(const BlockMatrix& A, const Interpolation& P);

  BlockMatrix make_coarse() const { return BlockMatrix(coarse_rows_, coarse_pairs_); }
  // To be called once with what make_coarse returned; forgets the pairs.
  void make_maps(const BlockMatrix& A, const BlockMatrix& coarse);
  // The values. Held degrees of freedom of A, whose rows and columns are the identity's, take no part.
  void calc(const BlockMatrix& A, BlockMatrix& coarse);

 private:
  void make_slabs();

  const Interpolation& P_;
  std::int32_t coarse_rows_ = 0;
  BlockMatrix::Pairs coarse_pairs_;
  // By fine row i: the m coarse nodes that its neighbours have as parents (slots), for every neighbour and parent its
  // slot, for every own parent its slot, and for that and the
  // later ones the block's number: only the upper triangle is summed up.
  std::vector<std::int32_t> slot_counts_;
  std::vector<std::int64_t> slot_starts_, target_starts_;
  std::vector<std::uint16_t> slots_, own_slots_;
  std::vector<std::int32_t> targets_;
  std::int32_t most_slots_ = 0;
  std::vector<std::int32_t> mirrors_;  // by block below the diagonal, in their order: the transposed one
  std::vector<std::int64_t> mirror_starts_;
  // Rows by their first parent, cut into slabs; every other slab at a time shares no coarse row.
  std::vector<std::int32_t> order_;
  std::vector<std::int64_t> slab_starts_;
  std::vector<std::vector<double>> scratch_;  // per slab
};

}  // namespace flexcast
