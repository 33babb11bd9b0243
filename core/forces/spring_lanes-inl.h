// The direction and length of springs in lanes.
#if defined(FLEXCAST_FORCES_SPRING_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_FORCES_SPRING_LANES_INL_H
#undef FLEXCAST_FORCES_SPRING_LANES_INL_H
#else
#define FLEXCAST_FORCES_SPRING_LANES_INL_H
#endif

#include "core/base/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

struct Direction {
  Vec n;
  Real l;
};

// spring.h's bounds: squares of shorter and longer lengths leave the range of a double. Such lanes are scaled first, by
// a power of two; coincident ends have no direction.
HWY_INLINE Direction calc_direction(Vec d) {
  Real squared = dot(d, d), scale = 1.0;
  const auto usual = hn::And(hn::Gt(squared.v, Real(1e-280).v), hn::Lt(squared.v, Real(1e280).v));
  if (HWY_UNLIKELY(!hn::AllTrue(Lanes(), usual))) {
    constexpr double huge = 0x1p600;
    const Real size = max(max(hn::Abs(d.x.v), hn::Abs(d.y.v)), Real(hn::Abs(d.z.v)));
    const Real factor = hn::IfThenElse(hn::Lt(size.v, Real(1.0).v), Real(huge).v, Real(1.0 / huge).v);
    scale = hn::IfThenElse(usual, Real(1.0).v, factor.v);
    d = scale * d;
    squared = dot(d, d);
  }
  const Real l = sqrt(squared);
  const Real inverse = hn::IfThenElseZero(hn::Gt(l.v, hn::Zero(Lanes())), (Real(1.0) / l).v);
  return {inverse * d, l / scale};
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
