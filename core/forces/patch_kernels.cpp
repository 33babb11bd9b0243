#include "core/forces/patch_kernels.h"

#include <hwy/cache_control.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/forces/patch_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include "core/base/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

void gather_rows(std::int32_t slots, const std::uint16_t* counts, const std::uint16_t* list, const double* rows,
                 double* sums) {
  for (std::int32_t slot = 0; slot < slots; ++slot, sums += 3) {
    FourSum sum;
    for (int k = 0; k < counts[2 * slot]; ++k) sum.add(rows + 4 * *list++);
    for (int k = 0; k < counts[2 * slot + 1]; ++k) sum.subtract(rows + 4 * *list++);
    sum.store_three(sums);
  }
}

HWY_INLINE void prefetch_nine(const double* from) {
  hwy::Prefetch(from);
  hwy::Prefetch(from + 8);
}

HWY_INLINE void add_nine(const double* sum, double* to) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  hn::StoreU(hn::Add(hn::LoadU(Four(), to), hn::Load(Four(), sum)), Four(), to);
  hn::StoreU(hn::Add(hn::LoadU(Four(), to + 4), hn::Load(Four(), sum + 4)), Four(), to + 4);
  to[8] += sum[8];
#else
  for (int i = 0; i < 9; ++i) to[i] += sum[i];
#endif
}

void gather_blocks(std::int32_t blocks, const std::int32_t* places, const std::uint16_t* counts,
                   const std::uint16_t* list, const double* entries, const double* lasts, double* values) {
  // Where the sums go is rarely in a cache: it is asked for some blocks ahead. The last ones ask again for themselves.
  constexpr std::int32_t ahead = 8;
  for (std::int32_t block = 0; block < blocks; ++block, places += 2, counts += 2) {
    const std::int32_t* later = places + 2 * HWY_MIN(ahead, blocks - 1 - block);
    prefetch_nine(values + 9 * static_cast<std::int64_t>(later[0]));
    if (later[1] >= 0) prefetch_nine(values + 9 * static_cast<std::int64_t>(later[1]));
    HWY_ALIGN double sum[12];
    NineSum as_they_are;
    for (int k = 0; k < counts[0]; ++k, ++list) as_they_are.add(entries + 8 * *list, lasts[*list]);
    as_they_are.store(sum);
    if (counts[1] > 0) {
      HWY_ALIGN double turned[12];
      NineSum transposed;
      for (int k = 0; k < counts[1]; ++k, ++list) transposed.add(entries + 8 * *list, lasts[*list]);
      transposed.store(turned);
      for (int i = 0; i < 9; ++i) sum[i] += turned[i % 3 * 3 + i / 3];
    }
    add_nine(sum, values + 9 * static_cast<std::int64_t>(places[0]));
    if (places[1] < 0) continue;
    HWY_ALIGN const double image[12] = {sum[0], sum[3], sum[6], sum[1], sum[4], sum[7], sum[2], sum[5], sum[8]};
    add_nine(image, values + 9 * static_cast<std::int64_t>(places[1]));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(gather_rows);
HWY_EXPORT(gather_blocks);

void gather_rows(std::int32_t slots, const std::uint16_t* counts, const std::uint16_t* list, const double* rows,
                 double* sums) {
  HWY_DYNAMIC_DISPATCH(gather_rows)(slots, counts, list, rows, sums);
}

void gather_blocks(std::int32_t blocks, const std::int32_t* places, const std::uint16_t* counts,
                   const std::uint16_t* list, const double* entries, const double* lasts, double* values) {
  HWY_DYNAMIC_DISPATCH(gather_blocks)(blocks, places, counts, list, entries, lasts, values);
}

}  // namespace flexcast
#endif
