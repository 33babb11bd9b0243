// The innermost loop of P^T A P, in the widest instructions the processor has.
#pragma once

#include "core/base/block_matrix.h"

namespace flexcast {

struct GalerkinMaps {
  const std::int64_t* parent_starts = nullptr;  // by fine row, into parents and weights
  const std::int32_t* parents = nullptr;
  const double* weights = nullptr;
  const std::int32_t* slot_counts = nullptr;    // by fine row
  const std::int64_t* slot_starts = nullptr;    // by fine row, into slots
  const std::int64_t* target_starts = nullptr;  // by fine row, into targets
  const std::uint16_t* slots = nullptr;
  const std::uint16_t* own_slots = nullptr;  // by parent, as parents and weights: its own slot
  const std::int32_t* targets = nullptr;
  const std::int32_t* order = nullptr;  // fine rows
};

// Adds w_ic w_jd A_ij to coarse blocks (c, d) for the fine rows order[first] to order[end - 1], all j, parents c of i
// and d >= c of j. scratch: 12 doubles a slot.
void add_galerkin_rows(const BlockRows& A, const GalerkinMaps& maps, std::int64_t first, std::int64_t end,
                       double* scratch, double* coarse);

}  // namespace flexcast
