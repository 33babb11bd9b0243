// The law of neo_hookean.h in lanes; neo_hookean.cpp says why the terms are written so.
#if defined(FLEXCAST_MATERIALS_NEO_HOOKEAN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_MATERIALS_NEO_HOOKEAN_INL_H
#undef FLEXCAST_MATERIALS_NEO_HOOKEAN_INL_H
#else
#define FLEXCAST_MATERIALS_NEO_HOOKEAN_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>

#include "core/base/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

struct NeoHookeanKernel {
  Real mu, lambda;

  HWY_INLINE Real calc_l() const { return fma(Real(5.0 / 6.0), mu, lambda); }
  HWY_INLINE Real calc_factor(Real t) const { return fma(mu, t / (Real(3.0) * (t + Real(2.0))), mu); }

  HWY_INLINE Mat calc_stress(const Mat& F) const {
    const Mat cofactor = calc_cofactor(F);
    const Real t = Real(0.5) * (dot(F, F) - Real(3.0)), j = dot(F.c0, cofactor.c0) - Real(1.0);
    return fma(calc_factor(t), F, fma(calc_l(), j, -mu) * cofactor);
  }
  HWY_INLINE Real calc_energy(const Mat& F) const {
    const Mat e = Real(0.5) * add_to_diagonal(calc_gram(F), Real(-1.0));
    const Real t = trace(e), j = dot(F.c0, cross(F.c1, F.c2)) - Real(1.0), square = dot(e, e);
    const Real small = fma(Real(0.5) * j, j, square) - fma(t, t, Real(4.0) * dot(e.c0, cross(e.c1, e.c2)));
    const Real distortion = hn::IfThenElse(hn::Lt(square.v, Real(1.0).v), small.v, (t - j).v);
    const Real half = Real(0.5) * t, logarithmic = half - Real(hn::Log1p(Lanes(), half.v));
    return fma(mu, fma(Real(2.0 / 3.0), logarithmic, distortion), Real(0.5) * calc_l() * j * j);
  }

  // With f = F g, h = cof F g, p = l (J - 1) - mu: g_a . dP/dF . g_b =
  //   factor (g_a . g_b) I + 2 mu / (3 (t + 2)^2) f_a f_b^T + l h_a h_b^T - p [F (g_a x g_b)].
  struct Point {
    Mat F, cofactor;
    Real factor, slope, pressure;
  };
  struct Node {
    Vec g, f, h;
  };
  template <bool clamped>
  HWY_INLINE Point calc_point(const Mat& F) const {
    const Mat cofactor = calc_cofactor(F);
    const Real t = Real(0.5) * (dot(F, F) - Real(3.0)), j = dot(F.c0, cofactor.c0) - Real(1.0);
    const Real u = t + Real(2.0);
    return {F, cofactor, calc_factor(t), Real(2.0 / 3.0) * mu / (u * u), fma(calc_l(), j, -mu)};
  }
  HWY_INLINE Node calc_node(const Point& point, const Vec& g) const { return {g, point.F * g, point.cofactor * g}; }
  HWY_INLINE Mat calc_block(const Point& point, const Node& a, const Node& b) const {
    const Vec q = point.pressure * (point.F * cross(a.g, b.g));
    Mat block = outer(point.slope * a.f, b.f) + outer(calc_l() * a.h, b.h);
    block.c0 = block.c0 - Vec{Real(0.0), q.z, -q.y};
    block.c1 = block.c1 - Vec{-q.z, Real(0.0), q.x};
    block.c2 = block.c2 - Vec{q.y, -q.x, Real(0.0)};
    return add_to_diagonal(block, point.factor * dot(a.g, b.g));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
