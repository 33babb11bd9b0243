// Tetrahedra in lanes, one element a lane: their nodes' vectors, the gradients of these at the quadrature points, and
// the way back from stresses to forces. Equations: element_shape.h, element.h.
#if defined(FLEXCAST_FORCES_ELEMENT_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_FORCES_ELEMENT_LANES_INL_H
#undef FLEXCAST_FORCES_ELEMENT_LANES_INL_H
#else
#define FLEXCAST_FORCES_ELEMENT_LANES_INL_H
#endif

#include "core/base/simd-inl.h"
#include "core/forces/tetrahedra_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

// With D_q the derivative of a motion with respect to xi, eta, zeta at point q, its gradient is D_q times the inverse
// edges. A shape knows D_q of the nodes' vectors relative to the first node's, and what slopes dE/dD_q mean for them.
struct LinearLanes {
  static constexpr int nodes = 4, points = 1;
  struct Motion {
    Mat D;
  };
  static HWY_INLINE Motion make_motion(const Vec (&x)[nodes]) { return {{x[1] - x[0], x[2] - x[0], x[3] - x[0]}}; }
  static HWY_INLINE Mat calc_derivative(const Motion& motion, int) { return motion.D; }

  struct Slopes {
    Mat D;
    HWY_INLINE void add(int, const Mat& dD) { D = dD; }
    // dE/dx.
    HWY_INLINE void calc_node_slopes(Vec (&s)[nodes]) const {
      s[0] = Real(-1.0) * (D.c0 + D.c1 + D.c2);
      s[1] = D.c0;
      s[2] = D.c1;
      s[3] = D.c2;
    }
  };
  // grad N_a from those of the barycentric coordinates.
  static HWY_INLINE Vec calc_shape_gradient(const Vec (&grad_L)[4], int, int a) { return grad_L[a]; }
};

// dx/dL_a at point q is (4 beta - 1) x_a + 4 beta sum_c x_ac, and there is c times x_a (a = q) or x_aq (else) more,
// where beta = (5 - sqrt 5)/20 is the coordinate L_a of the other points and c = 4 / sqrt 5.
struct QuadraticLanes {
  static constexpr int nodes = 10, points = 4;
  static constexpr double beta = 0.13819660112501051518, c = 1.7888543819998317571;
  // Number of the node between corners a != b.
  static constexpr int midside(int a, int b) { return a > b ? midside(b, a) : a == 0 ? 3 + b : a == 1 ? 5 + b : 9; }

  struct Motion {
    Vec x[nodes], base[4];
  };
  static HWY_INLINE Motion make_motion(const Vec (&x)[nodes]) {
    Motion motion;
    for (int a = 1; a < nodes; ++a) motion.x[a] = x[a] - x[0];
    motion.x[0] = {Real(0.0), Real(0.0), Real(0.0)};
    const Vec(&u)[nodes] = motion.x;
    motion.base[0] = Real(4.0 * beta) * (u[4] + u[5] + u[6]);
    motion.base[1] = fma(Real(4.0 * beta), u[4] + u[7] + u[8], Real(4.0 * beta - 1.0) * u[1]);
    motion.base[2] = fma(Real(4.0 * beta), u[5] + u[7] + u[9], Real(4.0 * beta - 1.0) * u[2]);
    motion.base[3] = fma(Real(4.0 * beta), u[6] + u[8] + u[9], Real(4.0 * beta - 1.0) * u[3]);
    return motion;
  }
  static HWY_INLINE Mat calc_derivative(const Motion& motion, int q) {
    Vec g[4];
    for (int a = 0; a < 4; ++a) g[a] = fma(Real(c), motion.x[a == q ? a : midside(a, q)], motion.base[a]);
    return {g[1] - g[0], g[2] - g[0], g[3] - g[0]};
  }

  struct Slopes {
    Vec sum[4], at[nodes];  // of all points; of the one that a node is near
    HWY_INLINE Slopes() {
      const Vec zero{Real(0.0), Real(0.0), Real(0.0)};
      for (Vec& one : sum) one = zero;
      for (Vec& one : at) one = zero;
    }
    HWY_INLINE void add(int q, const Mat& dD) {
      const Vec g[4] = {Real(-1.0) * (dD.c0 + dD.c1 + dD.c2), dD.c0, dD.c1, dD.c2};
      for (int a = 0; a < 4; ++a) {
        sum[a] = sum[a] + g[a];
        Vec& near = at[a == q ? a : midside(a, q)];
        near = near + g[a];
      }
    }
    HWY_INLINE void calc_node_slopes(Vec (&s)[nodes]) const {
      for (int a = 0; a < 4; ++a) s[a] = fma(Real(4.0 * beta - 1.0), sum[a], Real(c) * at[a]);
      for (int a = 0; a < 3; ++a) {
        for (int b = a + 1; b < 4; ++b) {
          const int ab = midside(a, b);
          s[ab] = fma(Real(4.0 * beta), sum[a] + sum[b], Real(c) * at[ab]);
        }
      }
    }
  };
  // 4 L_a - 1 times grad L_a for corners, 4 (L_a grad L_b + L_b grad L_a) between them.
  static HWY_INLINE Vec calc_shape_gradient(const Vec (&grad_L)[4], int q, int node) {
    constexpr double alpha = beta + 0.25 * c;
    const auto L = [q](int a) HWY_ATTR { return a == q ? alpha : beta; };
    if (node < 4) return Real(4.0 * L(node) - 1.0) * grad_L[node];
    constexpr int first[6] = {0, 0, 0, 1, 1, 2}, second[6] = {1, 2, 3, 2, 3, 3};
    const int a = first[node - 4], b = second[node - 4];
    return fma(Real(4.0 * L(a)), grad_L[b], Real(4.0 * L(b)) * grad_L[a]);
  }
};

// Elements number b of a patch's batches, the lanes from `part` on.
template <class Shape>
struct ElementLanes {
  const std::uint16_t* places;
  Mat inverse_edges;
  Real weight;

  ElementLanes() = default;
  HWY_INLINE ElementLanes(const ElementBatches& elements, int b, int part)
      : places(elements.places + static_cast<std::int64_t>(b) * Shape::nodes * batch_lanes + part),
        inverse_edges(load_mat(elements.inverse_edges + static_cast<std::int64_t>(b) * 9 * batch_lanes + part)),
        weight(load(elements.weights + static_cast<std::int64_t>(b) * batch_lanes + part)) {}

  HWY_INLINE typename Shape::Motion load_motion(const double* vectors) const {
    Vec x[Shape::nodes];
    FLEXCAST_UNROLL
    for (int a = 0; a < Shape::nodes; ++a) x[a] = load_nodes(vectors, places + a * batch_lanes);
    return Shape::make_motion(x);
  }
  HWY_INLINE Mat calc_gradient(const typename Shape::Motion& motion, int q) const {
    return Shape::calc_derivative(motion, q) * inverse_edges;
  }
  // w dE/dD of a point with the stress P.
  HWY_INLINE Mat calc_point_slopes(const Mat& P) const { return weight * (P * transpose(inverse_edges)); }
  // One row a node.
  HWY_INLINE void store_node_slopes(const typename Shape::Slopes& slopes, double* rows) const {
    Vec s[Shape::nodes];
    slopes.calc_node_slopes(s);
    FLEXCAST_UNROLL
    for (int a = 0; a < Shape::nodes; ++a) store_rows(s[a], rows + a * 4 * batch_lanes);
  }
  HWY_INLINE Vec calc_shape_gradient(int q, int a) const {
    const Mat rows = transpose(inverse_edges);
    const Vec grad_L[4] = {Real(-1.0) * (rows.c0 + rows.c1 + rows.c2), rows.c0, rows.c1, rows.c2};
    return Shape::calc_shape_gradient(grad_L, q, a);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
