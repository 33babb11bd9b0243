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

// The trace of S from a = |F|^2, b = |cof F|^2 and d = det F, by Halley's method from above, where it converges
// monotonically: three times as many digits each time. Twice is enough unless the stretches differ by a third or so.
struct StretchSum {
  Real i;
  hn::Mask<Lanes> sure;
};

HWY_INLINE Real calc_halley_change(Real i, Real a, Real b, Real d) {
  const Real ii = fma(i, i, -a);
  const Real p = fma(ii, ii, fnma(Real(8.0) * d, i, Real(-4.0) * b));
  const Real slope = Real(4.0) * fma(i, ii, Real(-2.0) * d), curvature = fma(Real(12.0) * i, i, Real(-4.0) * a);
  return (Real(2.0) * p * slope) / fma(Real(2.0) * slope, slope, -(p * curvature));
}

// Several at once: the root takes a long chain of operations, which fills the time of the others'.
template <int n>
HWY_INLINE void calc_stretch_sums(const Real (&a)[n], const Real (&b)[n], const Real (&d)[n], StretchSum (&sums)[n]) {
  const auto is_small = [](Real change, Real i) HWY_ATTR { return hn::Le(hn::Abs(change.v), (Real(1e-6) * i).v); };
  Real second[n];
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) sums[m].i = sqrt(Real(3.0) * a[m]);
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) sums[m].i = sums[m].i - calc_halley_change(sums[m].i, a[m], b[m], d[m]);
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) second[m] = calc_halley_change(sums[m].i, a[m], b[m], d[m]);
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) {
    auto& [i, sure] = sums[m];
    i = i - second[m];
    sure = is_small(second[m], i);
    if (HWY_UNLIKELY(!hn::AllTrue(Lanes(), sure))) {
      const Real third = calc_halley_change(i, a[m], b[m], d[m]);
      const Real better = i - third;
      i = hn::IfThenElse(sure, i.v, better.v);
      sure = hn::Or(sure, is_small(third, i));
    }
  }
}
HWY_INLINE StretchSum calc_stretch_sum(Real a, Real b, Real d) {
  const Real as[1] = {a}, bs[1] = {b}, ds[1] = {d};
  StretchSum sums[1];
  calc_stretch_sums(as, bs, ds, sums);
  return sums[0];
}

// Q = f F + c cof F - g F C with C = F^T F, in lanes where that is sure.
struct PolarScalars {
  Mat C, cofactor;
  Real f, c, g, trace;
  hn::Mask<Lanes> sure;
};

template <int n>
HWY_INLINE void calc_polar_scalars(const Mat (&F)[n], PolarScalars (&polar)[n]) {
  Real a[n], b[n], d[n];
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) {
    polar[m].C = calc_gram(F[m]);
    polar[m].cofactor = calc_cofactor(F[m]);
    a[m] = trace(polar[m].C);
    b[m] = dot(polar[m].cofactor, polar[m].cofactor);
    d[m] = dot(F[m].c0, polar[m].cofactor.c0);
  }
  StretchSum sums[n];
  calc_stretch_sums(a, b, d, sums);
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) {
    const auto& [i, sum_is_sure] = sums[m];
    const Real product = fma(Real(0.5) * i, fma(i, i, -a[m]), -d[m]);
    polar[m].g = Real(1.0) / product;
    polar[m].c = i * polar[m].g;
    polar[m].f = Real(0.5) * fma(i, i, a[m]) * polar[m].g;
    polar[m].trace = i;
    polar[m].sure = hn::And(hn::Ge(product.v, (Real(0.05) * i * i * i).v), sum_is_sure);
  }
}

// Replaces Q in the lanes of a mask by the plain result.
inline HWY_NOINLINE void calc_plain_rotations(const Mat& F, hn::Mask<Lanes> where, Mat& Q) {
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

// The lower half of a symmetric matrix.
struct SymmetricLanes {
  Real xx, yx, zx, yy, zy, zz;
};

// What Q g, and V = Q S Q^T = F Q^T, are: enough for what one g meets. With B = F F^T,
//   Q g = ((i^2 + |F|^2)/2 F g + i cof F g - B F g) / (i ii - det F),
//   V = ((i^2 - ii) B - B B + i det F I) / (i ii - det F).
struct LeftPolarLanes {
  Vec q;
  SymmetricLanes V;
  Real trace, product;  // of V; i ii - det F
};

// Replaces the lanes of a mask by the plain result.
inline HWY_NOINLINE void calc_plain_left_polar(const Mat& F, const Vec& g, hn::Mask<Lanes> where,
                                               LeftPolarLanes& polar) {
  const auto choose = [&](Real& to, Real plain) HWY_ATTR { to = hn::IfThenElse(where, plain.v, to.v); };
  Mat Q = F;
  calc_plain_rotations(F, where, Q);
  const Vec q = Q * g;
  const Mat V = F * transpose(Q);
  const Real i = trace(V);
  choose(polar.q.x, q.x);
  choose(polar.q.y, q.y);
  choose(polar.q.z, q.z);
  choose(polar.V.xx, V.c0.x);
  choose(polar.V.yx, V.c0.y);
  choose(polar.V.zx, V.c0.z);
  choose(polar.V.yy, V.c1.y);
  choose(polar.V.zy, V.c1.z);
  choose(polar.V.zz, V.c2.z);
  choose(polar.trace, i);
  choose(polar.product, fma(Real(0.5) * i, fma(i, i, -dot(F, F)), -dot(F.c0, cross(F.c1, F.c2))));
}

HWY_INLINE LeftPolarLanes calc_left_polar(const Mat& F, const Vec& f, const Vec& g) {
  const Mat cofactor = calc_cofactor(F), rows = transpose(F);
  const SymmetricLanes B{dot(rows.c0, rows.c0), dot(rows.c1, rows.c0), dot(rows.c2, rows.c0),
                         dot(rows.c1, rows.c1), dot(rows.c2, rows.c1), dot(rows.c2, rows.c2)};
  const Vec B0{B.xx, B.yx, B.zx}, B1{B.yx, B.yy, B.zy}, B2{B.zx, B.zy, B.zz};
  const Real a = B.xx + B.yy + B.zz, b = dot(cofactor, cofactor), d = dot(F.c0, cofactor.c0);
  const auto [i, sum_is_sure] = calc_stretch_sum(a, b, d);
  const Real squares = fma(i, i, a), ii = fma(Real(-0.5), squares, i * i);
  LeftPolarLanes polar;
  polar.trace = i;
  polar.product = fma(i, ii, -d);
  const Real inverse = Real(1.0) / polar.product;
  const Vec Bf{dot(B0, f), dot(B1, f), dot(B2, f)};
  polar.q = inverse * (fma(Real(0.5) * squares, f, i * (cofactor * g)) - Bf);
  const Real first = Real(0.5) * squares * inverse, last = i * d * inverse;  // i^2 - ii is half of the squares
  polar.V = {fma(first, B.xx, fnma(inverse, dot(B0, B0), last)), fma(first, B.yx, -(inverse * dot(B1, B0))),
             fma(first, B.zx, -(inverse * dot(B2, B0))),         fma(first, B.yy, fnma(inverse, dot(B1, B1), last)),
             fma(first, B.zy, -(inverse * dot(B2, B1))),         fma(first, B.zz, fnma(inverse, dot(B2, B2), last))};
  const auto sure = hn::And(hn::Ge(polar.product.v, (Real(0.05) * i * i * i).v), sum_is_sure);
  if (HWY_UNLIKELY(!hn::AllTrue(Lanes(), sure))) calc_plain_left_polar(F, g, hn::Not(sure), polar);
  return polar;
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
