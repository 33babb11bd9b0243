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

HWY_INLINE PolarLanes calc_polar(const Mat& F) {
  const Mat C = calc_gram(F), cofactor = calc_cofactor(F);
  const Real a = trace(C), b = dot(cofactor, cofactor), d = dot(F.c0, cofactor.c0);
  // Halley's method from above, where it converges monotonically: three times as many digits each time.
  Real i = sqrt(Real(3.0) * a), change = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Real ii = fma(i, i, -a);
    const Real p = fma(ii, ii, fnma(Real(8.0) * d, i, Real(-4.0) * b));
    const Real slope = Real(4.0) * fma(i, ii, Real(-2.0) * d), curvature = fma(Real(12.0) * i, i, Real(-4.0) * a);
    change = (Real(2.0) * p * slope) / fma(Real(2.0) * slope, slope, -(p * curvature));
    i = i - change;
  }
  const Real product = fma(Real(0.5) * i, fma(i, i, -a), -d);
  PolarLanes polar;
  polar.Q = fma(Real(0.5) * fma(i, i, a), F, i * cofactor) - F * C;
  polar.Q = (Real(1.0) / product) * polar.Q;
  polar.trace = i;
  const auto sure =
      hn::And(hn::Ge(product.v, (Real(0.05) * i * i * i).v), hn::Le(hn::Abs(change.v), (Real(1e-6) * i).v));
  if (HWY_UNLIKELY(!hn::AllTrue(Lanes(), sure))) {
    calc_plain_rotations(F, hn::Not(sure), polar.Q);
    polar.trace = Real(hn::IfThenElse(sure, polar.trace.v, dot(polar.Q, F).v));
  }
  return polar;
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
