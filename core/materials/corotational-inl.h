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

  // P g and g . dP/dF . g of one g, without eigenvectors. With f = F g, q = Q g and T = tr(S) I - Q S Q^T, whose
  // eigenvalues are the sums of two stretches, [q] T^-1 [q]^T = ((q . t) T - t t^T) / det T where t = T q =
  // tr(S) q - f. So the block is
  //   2 mu (q . q) I + lambda q q^T + (factor / det T) ((q . t) T - t t^T),   factor = lambda tr(S - I) - 2 mu,
  // positive as long as all c_k > -2 mu. They are exact where they are at least -1.5 mu, that is where the sums are at
  // least -factor / (1.5 mu); elsewhere factor is raised until they must be, as no sum is below det T / tr(S)^2 (the
  // mean of the other two is at most tr(S)): the block is positive, and nowhere below the exact one.
  HWY_INLINE void calc_own(const Mat& F, const Vec& g, Vec& slope, Mat& block) const {
    constexpr double most = 1.5;
    const Vec f = F * g;
    const auto [q, V, i, product] = calc_left_polar(F, f, g);
    const Vec t = fma(i, q, Real(-1.0) * f);
    const Real stretch = i - Real(3.0);
    slope = fma(Real(2.0) * mu, f - q, lambda * stretch * q);
    const Real xx = i - V.xx, yy = i - V.yy, zz = i - V.zz, yx = -V.yx, zx = -V.zx, zy = -V.zy;

    const auto zero = hn::Zero(Lanes());
    Real factor = fma(lambda, stretch, Real(-2.0) * mu);
    const Real least = factor * (Real(-1.0 / most) / mu);
    const Real a = xx - least, b = yy - least, c = zz - least;
    const Real minor = fnma(yx, yx, a * b), mixed = fnma(yx, zx, a * zy);
    const Real rest = fnma(mixed, mixed, minor * fnma(zx, zx, a * c));  // a times the determinant
    const auto sure = hn::And(hn::Gt(a.v, zero), hn::And(hn::Gt(minor.v, zero), hn::Gt(rest.v, zero)));

    const Real size = max(i, Real(1e-6));  // nothing is divided by zero
    const Real determinant = max(product, Real(1e-6) * size * size * size);
    const Real bounded = max(factor, Real(-most) * mu * determinant / (size * size));
    factor = hn::IfThenElse(sure, factor.v, bounded.v);
    const Real twist = factor / determinant, along = twist * dot(q, t);
    const Vec lq = lambda * q, tt = twist * t;
    const Real isotropic = Real(2.0) * mu * dot(q, q);
    block.c0.x = fma(along, xx, isotropic) + fnma(tt.x, t.x, lq.x * q.x);
    block.c1.y = fma(along, yy, isotropic) + fnma(tt.y, t.y, lq.y * q.y);
    block.c2.z = fma(along, zz, isotropic) + fnma(tt.z, t.z, lq.z * q.z);
    block.c0.y = block.c1.x = fma(along, yx, fnma(tt.y, t.x, lq.y * q.x));
    block.c0.z = block.c2.x = fma(along, zx, fnma(tt.z, t.x, lq.z * q.x));
    block.c1.z = block.c2.y = fma(along, zy, fnma(tt.z, t.y, lq.z * q.y));
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
