// The law of linear.h in lanes.
#if defined(FLEXCAST_MATERIALS_LINEAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_MATERIALS_LINEAR_INL_H
#undef FLEXCAST_MATERIALS_LINEAR_INL_H
#else
#define FLEXCAST_MATERIALS_LINEAR_INL_H
#endif

#include "core/base/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

struct LinearKernel {
  Real mu, lambda;

  HWY_INLINE Mat calc_stress(const Mat& F) const {
    const Mat e = add_to_diagonal(calc_symmetric(F), Real(-1.0));
    return add_to_diagonal(Real(2.0) * mu * e, lambda * trace(e));
  }
  HWY_INLINE Real calc_energy(const Mat& F) const {
    const Mat e = add_to_diagonal(calc_symmetric(F), Real(-1.0));
    const Real t = trace(e);
    return fma(mu, dot(e, e), Real(0.5) * lambda * t * t);
  }

  // g_a . dP/dF . g_b = mu (g_a . g_b) I + mu g_b g_a^T + lambda g_a g_b^T.
  struct Point {};
  struct Node {
    Vec g;
  };
  template <bool clamped>
  HWY_INLINE Point calc_point(const Mat&) const {
    return {};
  }
  HWY_INLINE Node calc_node(const Point&, const Vec& g) const { return {g}; }
  HWY_INLINE Mat calc_block(const Point&, const Node& a, const Node& b) const {
    return add_to_diagonal(outer(mu * b.g, a.g) + outer(lambda * a.g, b.g), mu * dot(a.g, b.g));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
