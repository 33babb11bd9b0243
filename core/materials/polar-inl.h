// Polar decomposition in lanes, F = Q S as in polar.h, without iterating on matrices: the trace i of S is the largest
// root of (i^2 - |F|^2)^2 - 8 det(F) i - 4 |cof F|^2, and the characteristic equation of S turns powers of S into
//   ((i^2 + |F|^2)/2 F + i cof F - F F^T F) / (i ii - det F) = Q,  ii = (i^2 - |F|^2)/2.
// i ii - det F is the product of the sums of two signed stretches. Where that is small the formula loses digits, and
// those lanes take the plain way.
// Sources: A. Hoger, D. E. Carlson, Determination of the stretch and rotation in the polar decomposition of the
// deformation gradient, Quart. Appl. Math. 42 (1984); K. E. Atkinson, An Introduction to Numerical Analysis (Halley).
#if defined(FLEXCAST_MATERIALS_POLAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_MATERIALS_POLAR_INL_H
#undef FLEXCAST_MATERIALS_POLAR_INL_H
#else
#define FLEXCAST_MATERIALS_POLAR_INL_H
#endif

#include "core/base/simd-inl.h"
#include "core/materials/plain_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

struct PolarLanes {
  Mat Q;
  Real trace;  // of S
};

// Q = f F + c cof F - g F C with C = F^T F, in lanes where that is sure.
struct PolarScalars {
  Mat C, cofactor;
  Real f, c, g, trace;
  hn::Mask<Lanes> sure;
};

// Several at once: the root takes a long chain of operations, which fills the time of the others'.
template <int n>
HWY_INLINE void calc_polar_scalars(const Mat (&F)[n], PolarScalars (&polar)[n]) {
  Real a[n], b[n], d[n], i[n], change[n];
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) {
    polar[m].C = calc_gram(F[m]);
    polar[m].cofactor = calc_cofactor(F[m]);
    a[m] = trace(polar[m].C);
    b[m] = Real(-4.0) * dot(polar[m].cofactor, polar[m].cofactor);
    d[m] = dot(F[m].c0, polar[m].cofactor.c0);
    i[m] = sqrt(Real(3.0) * a[m]);
  }
  // Halley's method from above, where it converges monotonically: three times as many digits each time.
  FLEXCAST_UNROLL
  for (int k = 0; k < 3; ++k) {
    FLEXCAST_UNROLL
    for (int m = 0; m < n; ++m) {
      const Real ii = fma(i[m], i[m], -a[m]);
      const Real p = fma(ii, ii, fnma(Real(8.0) * d[m], i[m], b[m]));
      const Real slope = Real(4.0) * fma(i[m], ii, Real(-2.0) * d[m]);
      const Real curvature = fma(Real(12.0) * i[m], i[m], Real(-4.0) * a[m]);
      change[m] = (Real(2.0) * p * slope) / fma(Real(2.0) * slope, slope, -(p * curvature));
      i[m] = i[m] - change[m];
    }
  }
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) {
    const Real product = fma(Real(0.5) * i[m], fma(i[m], i[m], -a[m]), -d[m]);
    polar[m].g = Real(1.0) / product;
    polar[m].c = i[m] * polar[m].g;
    polar[m].f = Real(0.5) * fma(i[m], i[m], a[m]) * polar[m].g;
    polar[m].trace = i[m];
    polar[m].sure = hn::And(hn::Ge(product.v, (Real(0.05) * i[m] * i[m] * i[m]).v),
                            hn::Le(hn::Abs(change[m].v), (Real(1e-6) * i[m]).v));
  }
}

// Replaces Q in the lanes of a mask by the plain result.
HWY_NOINLINE void calc_plain_rotations(const Mat& F, hn::Mask<Lanes> where, Mat& Q) {
  HWY_ALIGN double in[9 * batch_lanes], out[9 * batch_lanes], chosen[lane_count];
  store_mat(F, in);
  store_mat(Q, out);
  store(hn::IfThenElse(where, hn::Set(Lanes(), 1.0), hn::Zero(Lanes())), chosen);
  for (int lane = 0; lane < lane_count; ++lane) {
    if (chosen[lane] != 0.0) calc_plain_rotation(in + lane, out + lane, batch_lanes);
  }
  Q = load_mat(out);
}

HWY_INLINE PolarLanes calc_polar(const Mat& F, const PolarScalars& scalars) {
  PolarLanes polar{fma(scalars.f, F, scalars.c * scalars.cofactor) - F * (scalars.g * scalars.C), scalars.trace};
  if (HWY_UNLIKELY(!hn::AllTrue(Lanes(), scalars.sure))) {
    calc_plain_rotations(F, hn::Not(scalars.sure), polar.Q);
    polar.trace = Real(hn::IfThenElse(scalars.sure, polar.trace.v, dot(polar.Q, F).v));
  }
  return polar;
}
HWY_INLINE PolarLanes calc_polar(const Mat& F) {
  const Mat one[1] = {F};
  PolarScalars scalars[1];
  calc_polar_scalars(one, scalars);
  return calc_polar(F, scalars[0]);
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
