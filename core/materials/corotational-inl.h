// The law of corotational.h in lanes.
#if defined(FLEXCAST_MATERIALS_COROTATIONAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_MATERIALS_COROTATIONAL_INL_H
#undef FLEXCAST_MATERIALS_COROTATIONAL_INL_H
#else
#define FLEXCAST_MATERIALS_COROTATIONAL_INL_H
#endif

#include "core/base/simd-inl.h"
#include "core/materials/polar-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

struct CorotationalKernel {
  Real mu, lambda;
  double plain_mu, plain_lambda;

  HWY_INLINE Mat calc_stress(const Mat& F, const PolarScalars& scalars) const {
    // 2 mu F + k Q with k = lambda tr(S - I) - 2 mu, without Q: F times a symmetric matrix, and cof F.
    const Real k = fma(lambda, scalars.trace - Real(3.0), Real(-2.0) * mu);
    const Mat S = add_to_diagonal(-(k * scalars.g) * scalars.C, fma(k, scalars.f, Real(2.0) * mu));
    Mat P = fma(k * scalars.c, scalars.cofactor, F * S);
    if (HWY_UNLIKELY(!hn::AllTrue(Lanes(), scalars.sure))) {
      P = choose(scalars.sure, P, calc_stress(F, calc_polar(F, scalars)));
    }
    return P;
  }
  HWY_INLINE Real calc_energy(const Mat& F, const PolarScalars& scalars) const {
    const PolarLanes polar = calc_polar(F, scalars);
    const Mat stretch = F - polar.Q;
    const Real t = polar.trace - Real(3.0);
    return fma(mu, dot(stretch, stretch), Real(0.5) * lambda * t * t);
  }

  // With q = Q g and [q] b = q x b: g_a . dP/dF . g_b = 2 mu (q_a . q_b) I + lambda q_a q_b^T + [q_a] W [q_b]^T, where
  // W = Q sum_k c_k n_k n_k^T Q^T has the axes n_k of S and c_k = (lambda tr(S - I) - 2 mu) / (tr(S) - s_k).
  struct Point {
    Mat Q, W;
  };
  struct Node {
    Vec q;
    Mat rows;  // those of [q] W as columns
  };
  template <bool clamped>
  HWY_INLINE Point calc_point(const Mat& F) const {
    const PolarLanes polar = calc_polar(F);
    const Mat S = calc_symmetric(transpose(polar.Q) * F);
    // (tr(S) I - S)^-1 through its cofactors; corotational.cpp says why the sums of stretches are bounded.
    const Mat sums = add_to_diagonal(Real(-1.0) * S, polar.trace);
    const Mat cofactor = calc_cofactor(sums);
    const Real determinant = dot(sums.c0, cofactor.c0);
    const Real factor = fma(lambda, polar.trace - Real(3.0), Real(-2.0) * mu);
    Mat W = (factor / determinant) * cofactor;
    // The sums are at least `least`, so far is all as it should be: as positive as leading minors say.
    const Real least = clamped ? max(Real(1e-8), -(factor / mu)) : Real(1e-8);
    const Mat rest = add_to_diagonal(sums, -least);
    const Mat minors = calc_cofactor(rest);
    const auto zero = hn::Zero(Lanes());
    const auto sure = hn::And(hn::Gt(rest.c0.x.v, zero),
                              hn::And(hn::Gt(minors.c2.z.v, zero), hn::Gt(dot(rest.c0, minors.c0).v, zero)));
    if (HWY_UNLIKELY(!hn::AllTrue(Lanes(), sure))) calc_plain_twists<clamped>(S, hn::Not(sure), W);
    return {polar.Q, polar.Q * W * transpose(polar.Q)};
  }
  HWY_INLINE Node calc_node(const Point& point, const Vec& g) const {
    const Vec q = point.Q * g;
    return {q, transpose({cross(q, point.W.c0), cross(q, point.W.c1), cross(q, point.W.c2)})};
  }
  HWY_INLINE Mat calc_block(const Point&, const Node& a, const Node& b) const {
    // Row i of A [q]^T is q x (row i of A).
    const Mat twist = transpose({cross(b.q, a.rows.c0), cross(b.q, a.rows.c1), cross(b.q, a.rows.c2)});
    return add_to_diagonal(twist + outer(lambda * a.q, b.q), Real(2.0) * mu * dot(a.q, b.q));
  }

 private:
  HWY_INLINE Mat calc_stress(const Mat& F, const PolarLanes& polar) const {
    return fma(Real(2.0) * mu, F - polar.Q, lambda * (polar.trace - Real(3.0)) * polar.Q);
  }
  template <bool clamped>
  HWY_NOINLINE void calc_plain_twists(const Mat& S, hn::Mask<Lanes> where, Mat& W) const {
    HWY_ALIGN double in[9 * batch_lanes], out[9 * batch_lanes], chosen[lane_count];
    store_mat(S, in);
    store_mat(W, out);
    store(hn::IfThenElse(where, hn::Set(Lanes(), 1.0), hn::Zero(Lanes())), chosen);
    for (int lane = 0; lane < lane_count; ++lane) {
      if (chosen[lane] != 0.0) calc_plain_twist(plain_mu, plain_lambda, clamped, in + lane, out + lane, batch_lanes);
    }
    W = load_mat(out);
  }
};

template <int n>
HWY_INLINE void calc_stresses(const CorotationalKernel& kernel, const Mat (&F)[n], Mat (&P)[n]) {
  PolarScalars scalars[n];
  calc_polar_scalars(F, scalars);
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) P[m] = kernel.calc_stress(F[m], scalars[m]);
}
template <int n>
HWY_INLINE void calc_energies(const CorotationalKernel& kernel, const Mat (&F)[n], Real (&Psi)[n]) {
  PolarScalars scalars[n];
  calc_polar_scalars(F, scalars);
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) Psi[m] = kernel.calc_energy(F[m], scalars[m]);
}
template <int n>
HWY_INLINE void calc_energies_and_stresses(const CorotationalKernel& kernel, const Mat (&F)[n], Real (&Psi)[n],
                                           Mat (&P)[n]) {
  PolarScalars scalars[n];
  calc_polar_scalars(F, scalars);
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) {
    Psi[m] = kernel.calc_energy(F[m], scalars[m]);
    P[m] = kernel.calc_stress(F[m], scalars[m]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
