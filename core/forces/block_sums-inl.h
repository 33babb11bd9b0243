// What the lanes of a group add up for their particles, and the way from there to the particles' own arrays.
#if defined(FLEXCAST_FORCES_BLOCK_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_FORCES_BLOCK_SUMS_INL_H
#undef FLEXCAST_FORCES_BLOCK_SUMS_INL_H
#else
#define FLEXCAST_FORCES_BLOCK_SUMS_INL_H
#endif

#include "core/base/simd-inl.h"
#include "core/forces/block_groups.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

// A force and the lower half of a symmetric block.
struct BlockSums {
  Vec f;
  Real xx, yx, zx, yy, zy, zz;

  HWY_INLINE BlockSums() {
    xx = yx = zx = yy = zy = zz = Real(0.0);
    f = {xx, xx, xx};
  }
  HWY_INLINE void subtract(Real w, const Vec& slope) {
    f = {fnma(w, slope.x, f.x), fnma(w, slope.y, f.y), fnma(w, slope.z, f.z)};
  }
  HWY_INLINE void add(Real w, const Mat& block) {
    xx = fma(w, block.c0.x, xx);
    yx = fma(w, block.c0.y, yx);
    zx = fma(w, block.c0.z, zx);
    yy = fma(w, block.c1.y, yy);
    zy = fma(w, block.c1.z, zy);
    zz = fma(w, block.c2.z, zz);
  }
  // to_f[3 place], to_K[9 place] += these, for the lanes from `part` on.
  HWY_INLINE void put(const BlockGroup& group, int part, double* to_f, double* to_K) const {
    HWY_ALIGN double entries[9][lane_count];
    const Real all[9] = {f.x, f.y, f.z, xx, yx, zx, yy, zy, zz};
    for (int k = 0; k < 9; ++k) store(all[k], entries[k]);
    constexpr int half[9] = {3, 4, 5, 4, 6, 7, 5, 7, 8};
    for (int lane = 0; lane < lane_count; ++lane) {
      const std::int32_t place = group.places[part + lane];
      if (place < 0) continue;
      for (int k = 0; k < 3; ++k) to_f[3 * place + k] += entries[k][lane];
      for (int k = 0; k < 9; ++k) to_K[9 * place + k] += entries[half[k]][lane];
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
