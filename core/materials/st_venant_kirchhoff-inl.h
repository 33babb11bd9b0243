// The law of st_venant_kirchhoff.h in lanes.
#if defined(FLEXCAST_MATERIALS_ST_VENANT_KIRCHHOFF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_MATERIALS_ST_VENANT_KIRCHHOFF_INL_H
#undef FLEXCAST_MATERIALS_ST_VENANT_KIRCHHOFF_INL_H
#else
#define FLEXCAST_MATERIALS_ST_VENANT_KIRCHHOFF_INL_H
#endif

#include "core/base/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

struct StVenantKirchhoffKernel {
  Real mu, lambda;

  // 2 mu e + lambda tr(e) I of the Green strain e.
  HWY_INLINE Mat calc_second_stress(const Mat& F) const {
    const Mat twice = add_to_diagonal(calc_gram(F), Real(-1.0));
    return add_to_diagonal(mu * twice, Real(0.5) * lambda * trace(twice));
  }
  HWY_INLINE Mat calc_stress(const Mat& F) const { return F * calc_second_stress(F); }
  HWY_INLINE Real calc_energy(const Mat& F) const {
    const Mat e = Real(0.5) * add_to_diagonal(calc_gram(F), Real(-1.0));
    const Real t = trace(e);
    return fma(mu, dot(e, e), Real(0.5) * lambda * t * t);
  }

  // With f = F g, S the second stress: g_a . dP/dF . g_b =
  //   (g_a . S g_b) I + mu ((g_a . g_b) F F^T + f_b f_a^T) + lambda f_a f_b^T.
  struct Point {
    Mat F, S, B;  // B = F F^T
  };
  struct Node {
    Vec g, f, Sg;
  };
  template <bool clamped>
  HWY_INLINE Point calc_point(const Mat& F) const {
    return {F, calc_second_stress(F), calc_gram(transpose(F))};
  }
  HWY_INLINE Node calc_node(const Point& point, const Vec& g) const { return {g, point.F * g, point.S * g}; }
  HWY_INLINE Mat calc_block(const Point& point, const Node& a, const Node& b) const {
    const Mat block = fma(mu * dot(a.g, b.g), point.B, outer(mu * b.f, a.f) + outer(lambda * a.f, b.f));
    return add_to_diagonal(block, dot(a.g, b.Sg));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
