#include "core/solvers/galerkin_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solvers/galerkin_kernel.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_MAX_BYTES >= 32
using Lanes = hn::FixedTag<double, 4>;
#else
using Lanes = hn::FixedTag<double, 1>;
#endif
using OneLane = hn::FixedTag<double, 1>;

// to += w from; twelve entries, of which the last three are nobody's.
HWY_INLINE void add_twelve(const double* from, double w, double* to) {
  const Lanes d;
  const auto weight = hn::Set(d, w);
  for (std::size_t k = 0; k < 12; k += hn::Lanes(d)) {
    hn::StoreU(hn::MulAdd(weight, hn::LoadU(d, from + k), hn::LoadU(d, to + k)), d, to + k);
  }
}

HWY_INLINE void add_nine(const double* from, double w, double* to) {
  const Lanes d;
  const OneLane one;
  const auto weight = hn::Set(d, w);
  for (std::size_t k = 0; k < 8; k += hn::Lanes(d)) {
    hn::StoreU(hn::MulAdd(weight, hn::LoadU(d, from + k), hn::LoadU(d, to + k)), d, to + k);
  }
  hn::StoreU(hn::MulAdd(hn::Set(one, w), hn::LoadU(one, from + 8), hn::LoadU(one, to + 8)), one, to + 8);
}

// The entry of a held degree of freedom's diagonal is 1 and alone in its row of the block.
HWY_INLINE void copy_without_held(const BlockRows& A, std::int64_t row, std::int64_t diagonal, double* block) {
  const double* from = A.values + 9 * diagonal;
  for (int k = 0; k < 12; ++k) block[k] = k < 9 ? from[k] : 0.0;
  for (int r = 0; r < 3; ++r) {
    if (from[4 * r] != 1.0) continue;
    double others = 0.0;
    for (std::int64_t k = A.starts[row]; k < A.starts[row + 1]; ++k) {
      const double* b = A.values + 9 * k;
      for (int c = 0; c < 3; ++c) others += k == diagonal && c == r ? 0.0 : b[3 * c + r] * b[3 * c + r];
    }
    if (others == 0.0) block[4 * r] = 0.0;
  }
}

void add_rows(const BlockRows& A, const GalerkinMaps& maps, std::int64_t first, std::int64_t end, double* scratch,
              double* coarse) {
  for (std::int64_t n = first; n < end; ++n) {
    const std::int64_t i = maps.order[n];
    const std::int64_t parent_first = maps.parent_starts[i], parent_end = maps.parent_starts[i + 1];
    if (parent_first == parent_end) continue;
    if (n + 2 < end) {
      const std::int64_t later = maps.order[n + 2];
      const double* last = A.values + 9 * A.starts[later + 1];
      for (const double* p = A.values + 9 * A.starts[later]; p < last; p += 8) hwy::Prefetch(p);
    }
    const std::int32_t slots = maps.slot_counts[i];
    for (std::int32_t k = 0; k < 12 * slots; ++k) scratch[k] = 0.0;
    double diagonal[12];
    copy_without_held(A, i, A.diagonals[i], diagonal);
    const std::uint16_t* slot = maps.slots + maps.slot_starts[i];
    for (std::int64_t k = A.starts[i]; k < A.starts[i + 1]; ++k) {
      const double* block = k == A.diagonals[i] ? diagonal : A.values + 9 * k;
      const std::int32_t j = A.columns[k];
      for (std::int64_t q = maps.parent_starts[j]; q < maps.parent_starts[j + 1]; ++q) {
        add_twelve(block, maps.weights[q], scratch + 12 * static_cast<std::int64_t>(*slot++));
      }
    }
    const std::int32_t* target = maps.targets + maps.target_starts[i];
    for (std::int64_t p = parent_first; p < parent_end; ++p) {
      for (std::int32_t s = maps.own_slots[p]; s < slots; ++s) {
        add_nine(scratch + 12 * s, maps.weights[p], coarse + 9 * static_cast<std::int64_t>(*target++));
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(add_rows);

void add_galerkin_rows(const BlockRows& A, const GalerkinMaps& maps, std::int64_t first, std::int64_t end,
                       double* scratch, double* coarse) {
  HWY_DYNAMIC_DISPATCH(add_rows)(A, maps, first, end, scratch, coarse);
}

}  // namespace flexcast
#endif
