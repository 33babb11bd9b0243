// The damping of kelvin_voigt.h in lanes.
#if defined(FLEXCAST_FORCES_KELVIN_VOIGT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_FORCES_KELVIN_VOIGT_INL_H
#undef FLEXCAST_FORCES_KELVIN_VOIGT_INL_H
#else
#define FLEXCAST_FORCES_KELVIN_VOIGT_INL_H
#endif

#include "core/base/simd-inl.h"
#include "core/materials/linear-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

// Its matrix is that of St. Venant-Kirchhoff without the part of the present stress.
struct KelvinVoigtKernel {
  Real mu, lambda;
  static constexpr bool small_strain = false;

  HWY_INLINE Mat calc_stress(const Mat& F, const Mat& rate) const {
    const Mat E = calc_symmetric(transpose(F) * rate);
    return F * add_to_diagonal(Real(2.0) * mu * E, lambda * trace(E));
  }

  struct Point {
    Mat F, B;  // B = F F^T
  };
  struct Node {
    Vec g, f;
  };
  template <bool clamped>
  HWY_INLINE Point calc_point(const Mat& F) const {
    return {F, calc_gram(transpose(F))};
  }
  HWY_INLINE Node calc_node(const Point& point, const Vec& g) const { return {g, point.F * g}; }
  HWY_INLINE Mat calc_block(const Point& point, const Node& a, const Node& b) const {
    return fma(mu * dot(a.g, b.g), point.B, outer(mu * b.f, a.f) + outer(lambda * a.f, b.f));
  }
};
struct SmallKelvinVoigtKernel : LinearKernel {
  HWY_INLINE Mat calc_stress(const Mat&, const Mat& rate) const {
    const Mat e = calc_symmetric(rate);
    return add_to_diagonal(Real(2.0) * mu * e, lambda * trace(e));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
