#include "core/forces/tetrahedra_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/forces/tetrahedra_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include "core/base/simd-inl.h"
#include "core/forces/element_lanes-inl.h"
#include "core/forces/kelvin_voigt-inl.h"
#include "core/materials/corotational-inl.h"
#include "core/materials/linear-inl.h"
#include "core/materials/neo_hookean-inl.h"
#include "core/materials/plain_lanes.h"
#include "core/materials/st_venant_kirchhoff-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

// A law without code in lanes of its own.
struct PlainKernel {
  const Law* law;
  double mu, lambda;

  HWY_NOINLINE Mat calc_stress(const Mat& F) const {
    HWY_ALIGN double in[9 * batch_lanes], out[9 * batch_lanes];
    store_mat(F, in);
    for (int lane = 0; lane < lane_count; ++lane)
      calc_plain_stress(*law, mu, lambda, in + lane, out + lane, batch_lanes);
    return load_mat(out);
  }
  HWY_NOINLINE Real calc_energy(const Mat& F) const {
    HWY_ALIGN double in[9 * batch_lanes], out[batch_lanes];
    store_mat(F, in);
    for (int lane = 0; lane < lane_count; ++lane)
      out[lane] = calc_plain_energy(*law, mu, lambda, in + lane, batch_lanes);
    return load(out);
  }
};

// Points at once: a law may have a better way than one after the other.
template <int n, class Kernel>
HWY_INLINE void calc_stresses(const Kernel& kernel, const Mat (&F)[n], Mat (&P)[n]) {
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) P[m] = kernel.calc_stress(F[m]);
}
template <int n, class Kernel>
HWY_INLINE void calc_energies(const Kernel& kernel, const Mat (&F)[n], Real (&Psi)[n]) {
  FLEXCAST_UNROLL
  for (int m = 0; m < n; ++m) Psi[m] = kernel.calc_energy(F[m]);
}
template <int n, class Kernel>
HWY_INLINE void calc_energies_and_stresses(const Kernel& kernel, const Mat (&F)[n], Real (&Psi)[n], Mat (&P)[n]) {
  calc_energies(kernel, F, Psi);
  calc_stresses(kernel, F, P);
}

// Parts of batches, `group` at once: number k is part k of the lanes of a batch, batch after batch.
constexpr int parts = batch_lanes / lane_count;

template <int group, class Shape>
struct Elements {
  ElementLanes<Shape> lanes[group];
  Mat F[group * Shape::points];

  HWY_INLINE Elements(const ElementBatches& elements, int first, const double* x) {
    FLEXCAST_UNROLL
    for (int m = 0; m < group; ++m) {
      lanes[m] = ElementLanes<Shape>(elements, (first + m) / parts, (first + m) % parts * lane_count);
      const auto motion = lanes[m].load_motion(x);
      FLEXCAST_UNROLL
      for (int q = 0; q < Shape::points; ++q) F[m * Shape::points + q] = lanes[m].calc_gradient(motion, q);
    }
  }
};

template <int group, class Shape, class Kernel>
HWY_INLINE void calc_forces(const ElementBatches& elements, const Kernel& kernel, int first, const double* x,
                            double* rows) {
  const Elements<group, Shape> mine(elements, first, x);
  Mat P[group * Shape::points];
  calc_stresses(kernel, mine.F, P);
  FLEXCAST_UNROLL
  for (int m = 0; m < group; ++m) {
    typename Shape::Slopes slopes;
    FLEXCAST_UNROLL
    for (int q = 0; q < Shape::points; ++q) {
      slopes.add(q, mine.lanes[m].calc_point_slopes(P[m * Shape::points + q]));
    }
    const int batch = (first + m) / parts, lane = (first + m) % parts * lane_count;
    mine.lanes[m].store_node_slopes(slopes, rows + (batch * Shape::nodes * batch_lanes + lane) * 4);
  }
}

template <class Shape, class Kernel>
void calc_forces(const ElementBatches& elements, const Kernel& kernel, const double* x, double* rows) {
  constexpr int group = Shape::points == 1 ? 2 : 1;
  int first = 0;
  for (; first + group <= elements.count * parts; first += group) {
    calc_forces<group, Shape>(elements, kernel, first, x, rows);
  }
  for (; first < elements.count * parts; ++first) calc_forces<1, Shape>(elements, kernel, first, x, rows);
}

template <int group, class Shape, class Kernel>
HWY_INLINE void add_energies(const ElementBatches& elements, const Kernel& kernel, int first, const double* x,
                             LaneSums& sums) {
  const Elements<group, Shape> mine(elements, first, x);
  Real Psi[group * Shape::points];
  calc_energies(kernel, mine.F, Psi);
  for (int m = 0; m < group; ++m) {
    for (int q = 0; q < Shape::points; ++q) {
      sums.add((first + m) % parts * lane_count, mine.lanes[m].weight * Psi[m * Shape::points + q]);
    }
  }
}

template <class Shape, class Kernel>
double calc_energy(const ElementBatches& elements, const Kernel& kernel, const double* x) {
  constexpr int group = Shape::points == 1 ? 2 : 1;
  LaneSums sums;
  int first = 0;
  for (; first + group <= elements.count * parts; first += group) {
    add_energies<group, Shape>(elements, kernel, first, x, sums);
  }
  for (; first < elements.count * parts; ++first) add_energies<1, Shape>(elements, kernel, first, x, sums);
  return sums.total();
}

template <class Shape, class Kernel>
double calc_damping(const ElementBatches& elements, const Kernel& kernel, const double* x, const double* v,
                    double* rows) {
  LaneSums power;
  for (int b = 0; b < elements.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const ElementLanes<Shape> element(elements, b, part);
      const auto motion = element.load_motion(x), rates = element.load_motion(v);
      typename Shape::Slopes slopes;
      for (int q = 0; q < Shape::points; ++q) {
        const Mat rate = element.calc_gradient(rates, q);
        const Mat P = kernel.calc_stress(element.calc_gradient(motion, q), rate);
        slopes.add(q, element.calc_point_slopes(P));
        power.add(part, element.weight * dot(P, rate));
      }
      element.store_node_slopes(slopes, rows + (b * Shape::nodes * batch_lanes + part) * 4);
    }
  }
  return power.total();
}

template <class Shape, class Kernel>
void sweep_constraints(const ElementBatches& elements, const Kernel& kernel, const PatchSweep& sweep) {
  const Real s = sweep.h * sweep.h, s_d = sweep.h * sweep.damping;
  const auto zero = hn::Zero(Lanes());
  for (int b = 0; b < elements.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const ElementLanes<Shape> element(elements, b, part);
      Vec moved[Shape::nodes], x[Shape::nodes];
      for (int a = 0; a < Shape::nodes; ++a) {
        moved[a] = load_nodes(sweep.u, element.places + a * batch_lanes);
        x[a] = load_nodes(sweep.start, element.places + a * batch_lanes) + moved[a];
      }
      const auto motion = Shape::make_motion(x);
      Mat F[Shape::points], P[Shape::points];
      Real Psi[Shape::points];
      for (int q = 0; q < Shape::points; ++q) F[q] = element.calc_gradient(motion, q);
      calc_energies_and_stresses(kernel, F, Psi, P);
      Real U = 0.0;
      typename Shape::Slopes slopes;
      for (int q = 0; q < Shape::points; ++q) {
        U = fma(element.weight, Psi[q], U);
        slopes.add(q, element.calc_point_slopes(P[q]));
      }
      Vec grad_U[Shape::nodes], move[Shape::nodes];
      slopes.calc_node_slopes(grad_U);
      // grad C = grad U / C.
      const Real C = sqrt(Real(2.0) * U), inverse_C = Real(1.0) / C;
      Real W = 0.0, change = 0.0;
      for (int a = 0; a < Shape::nodes; ++a) {
        const Vec w = load_nodes(sweep.inverse_masses, element.places + a * batch_lanes);
        const Vec g = inverse_C * grad_U[a];
        move[a] = {w.x * g.x, w.y * g.y, w.z * g.z};
        W = W + dot(move[a], g);
        change = change + dot(g, moved[a]);
      }
      double* lambdas = sweep.lambda + static_cast<std::int64_t>(b) * batch_lanes + part;
      const Real lambda = load_unaligned(lambdas);
      const Real dlambda = (-(s * C) - lambda - s_d * change) / fma(s + s_d, W, Real(1.0));
      Real largest = hn::Abs(dlambda.v);
      auto usable = hn::And(hn::Gt(U.v, zero), hn::Lt(largest.v, Real(1e300).v));
      for (Vec& one : move) {
        one = dlambda * one;
        largest = hn::Abs(one.x.v) + hn::Abs(one.y.v) + hn::Abs(one.z.v);
        usable = hn::And(usable, hn::Lt(largest.v, Real(1e300).v));
      }
      for (Vec& one : move) {
        one = {hn::IfThenElseZero(usable, one.x.v), hn::IfThenElseZero(usable, one.y.v),
               hn::IfThenElseZero(usable, one.z.v)};
      }
      store_unaligned(lambda + Real(hn::IfThenElseZero(usable, dlambda.v)), lambdas);
      add_to_nodes(move, element.places, sweep.u);
    }
  }
}

template <bool clamped, class Shape, class Kernel>
void calc_stiffness(const ElementBatches& elements, const Kernel& kernel, double scale, const double* x,
                    const BlockRows9& rows) {
  constexpr int n = Shape::nodes, pairs = n * (n + 1) / 2;
  for (int b = 0; b < elements.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const ElementLanes<Shape> element(elements, b, part);
      const auto motion = element.load_motion(x);
      const Real weight = Real(scale) * element.weight;
      typename Kernel::Point points[Shape::points];
      typename Kernel::Node nodes[Shape::points][n];
      for (int q = 0; q < Shape::points; ++q) {
        points[q] = kernel.template calc_point<clamped>(element.calc_gradient(motion, q));
        for (int a = 0; a < n; ++a) nodes[q][a] = kernel.calc_node(points[q], element.calc_shape_gradient(q, a));
      }
      const auto calc_block = [&](int i, int j) HWY_ATTR {
        Mat block = kernel.calc_block(points[0], nodes[0][i], nodes[0][j]);
        for (int q = 1; q < Shape::points; ++q) block = block + kernel.calc_block(points[q], nodes[q][i], nodes[q][j]);
        return weight * block;
      };
      const int row = b * pairs * batch_lanes + part;
      const auto put = [&](int pair, const Mat& block) HWY_ATTR {
        store_blocks(block, rows.entries + 8 * (row + pair * batch_lanes), rows.lasts + row + pair * batch_lanes);
      };
      if constexpr (n == 4) {
        // A motion as a whole strains nothing: the blocks of a row add up to zero.
        const Mat K11 = calc_block(1, 1), K12 = calc_block(1, 2), K13 = calc_block(1, 3);
        const Mat K22 = calc_block(2, 2), K23 = calc_block(2, 3), K33 = calc_block(3, 3);
        put(4, K11), put(5, K12), put(6, K13), put(7, K22), put(8, K23), put(9, K33);
        const Mat K10 = Real(-1.0) * (K11 + K12 + K13), K20 = Real(-1.0) * (transpose(K12) + K22 + K23);
        const Mat K30 = Real(-1.0) * (transpose(K13) + transpose(K23) + K33);
        put(0, Real(-1.0) * (K10 + K20 + K30));
        put(1, transpose(K10)), put(2, transpose(K20)), put(3, transpose(K30));
      } else {
        int pair = 0;
        for (int i = 0; i < n; ++i) {
          for (int j = i; j < n; ++j) put(pair++, calc_block(i, j));
        }
      }
    }
  }
}

// Calls visit.run<Shape>(kernel) for the shape and law asked for.
template <class Visit>
HWY_INLINE void choose_shape(const ElementBatches& elements, Visit& visit, const auto& kernel) {
  if (elements.quadratic) {
    visit.template run<QuadraticLanes>(kernel);
  } else {
    visit.template run<LinearLanes>(kernel);
  }
}

template <class Visit>
HWY_INLINE bool choose_kernel(const ElementBatches& elements, const ElementLaw& law, Visit& visit) {
  const Real mu = law.lame.mu, lambda = law.lame.lambda;
  switch (law.law->kernel) {
    case LawKernel::linear:
      choose_shape(elements, visit, LinearKernel{mu, lambda});
      return true;
    case LawKernel::corotational:
      choose_shape(elements, visit, CorotationalKernel{mu, lambda, law.lame.mu, law.lame.lambda});
      return true;
    case LawKernel::st_venant_kirchhoff:
      choose_shape(elements, visit, StVenantKirchhoffKernel{mu, lambda});
      return true;
    case LawKernel::neo_hookean:
      choose_shape(elements, visit, NeoHookeanKernel{mu, lambda});
      return true;
    case LawKernel::none:
      return false;
  }
  return false;
}

template <class Visit>
HWY_INLINE void choose_damping(const ElementBatches& elements, const ElementLaw& law, Visit& visit) {
  const Real mu = law.viscosity.mu, lambda = law.viscosity.lambda;
  if (law.small_strain) {
    choose_shape(elements, visit, SmallKelvinVoigtKernel{{mu, lambda}});
  } else {
    choose_shape(elements, visit, KelvinVoigtKernel{mu, lambda});
  }
}

struct CalcForces {
  const ElementBatches& elements;
  const double* x;
  double* rows;
  template <class Shape>
  void run(const auto& kernel) {
    calc_forces<Shape>(elements, kernel, x, rows);
  }
};

void calc_patch_forces(const ElementBatches& elements, const ElementLaw& law, const double* x, double* rows) {
  CalcForces visit{elements, x, rows};
  if (!choose_kernel(elements, law, visit)) {
    choose_shape(elements, visit, PlainKernel{law.law, law.lame.mu, law.lame.lambda});
  }
}

struct CalcEnergy {
  const ElementBatches& elements;
  const double* x;
  double energy = 0.0;
  template <class Shape>
  void run(const auto& kernel) {
    energy = calc_energy<Shape>(elements, kernel, x);
  }
};

double calc_patch_energy(const ElementBatches& elements, const ElementLaw& law, const double* x) {
  CalcEnergy visit{elements, x};
  if (!choose_kernel(elements, law, visit)) {
    choose_shape(elements, visit, PlainKernel{law.law, law.lame.mu, law.lame.lambda});
  }
  return visit.energy;
}

struct CalcDamping {
  const ElementBatches& elements;
  const double* x;
  const double* v;
  double* rows;
  double power = 0.0;
  template <class Shape>
  void run(const auto& kernel) {
    power = calc_damping<Shape>(elements, kernel, x, v, rows);
  }
};

double calc_patch_damping(const ElementBatches& elements, const ElementLaw& law, const double* x, const double* v,
                          double* rows) {
  CalcDamping visit{elements, x, v, rows};
  choose_damping(elements, law, visit);
  return visit.power;
}

struct SweepConstraints {
  const ElementBatches& elements;
  const PatchSweep& sweep;
  template <class Shape>
  void run(const auto& kernel) {
    sweep_constraints<Shape>(elements, kernel, sweep);
  }
};

void sweep_patch_constraints(const ElementBatches& elements, const ElementLaw& law, const PatchSweep& sweep) {
  SweepConstraints visit{elements, sweep};
  if (!choose_kernel(elements, law, visit)) {
    choose_shape(elements, visit, PlainKernel{law.law, law.lame.mu, law.lame.lambda});
  }
}

template <bool clamped>
struct CalcStiffness {
  const ElementBatches& elements;
  double scale;
  const double* x;
  const BlockRows9& rows;
  template <class Shape>
  void run(const auto& kernel) {
    calc_stiffness<clamped, Shape>(elements, kernel, scale, x, rows);
  }
};

void calc_patch_stiffness(const ElementBatches& elements, const ElementLaw& law, Tangent kind, double scale,
                          const double* x, const BlockRows9& rows) {
  if (kind == Tangent::positive_semidefinite && law.law->kernel == LawKernel::corotational) {
    CalcStiffness<true> visit{elements, scale, x, rows};
    choose_shape(elements, visit, CorotationalKernel{law.lame.mu, law.lame.lambda, law.lame.mu, law.lame.lambda});
  } else {
    CalcStiffness<false> visit{elements, scale, x, rows};
    choose_kernel(elements, law, visit);
  }
}

void calc_patch_damping_matrix(const ElementBatches& elements, const ElementLaw& law, double scale, const double* x,
                               const BlockRows9& rows) {
  CalcStiffness<false> visit{elements, scale, x, rows};
  choose_damping(elements, law, visit);
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(calc_patch_forces);
HWY_EXPORT(calc_patch_energy);
HWY_EXPORT(calc_patch_damping);
HWY_EXPORT(sweep_patch_constraints);
HWY_EXPORT(calc_patch_stiffness);
HWY_EXPORT(calc_patch_damping_matrix);

void calc_patch_forces(const ElementBatches& elements, const ElementLaw& law, const double* x, double* rows) {
  HWY_DYNAMIC_DISPATCH(calc_patch_forces)(elements, law, x, rows);
}

double calc_patch_energy(const ElementBatches& elements, const ElementLaw& law, const double* x) {
  return HWY_DYNAMIC_DISPATCH(calc_patch_energy)(elements, law, x);
}

double calc_patch_damping(const ElementBatches& elements, const ElementLaw& law, const double* x, const double* v,
                          double* rows) {
  return HWY_DYNAMIC_DISPATCH(calc_patch_damping)(elements, law, x, v, rows);
}

void sweep_patch_constraints(const ElementBatches& elements, const ElementLaw& law, const PatchSweep& sweep) {
  HWY_DYNAMIC_DISPATCH(sweep_patch_constraints)(elements, law, sweep);
}

bool has_stiffness_in_lanes(const Law& law, Tangent kind) {
  if (law.kernel == LawKernel::linear || law.kernel == LawKernel::corotational) return true;
  return law.kernel != LawKernel::none && kind == Tangent::exact;
}

void calc_patch_stiffness(const ElementBatches& elements, const ElementLaw& law, Tangent kind, double scale,
                          const double* x, const BlockRows9& rows) {
  HWY_DYNAMIC_DISPATCH(calc_patch_stiffness)(elements, law, kind, scale, x, rows);
}

void calc_patch_damping_matrix(const ElementBatches& elements, const ElementLaw& law, double scale, const double* x,
                               const BlockRows9& rows) {
  HWY_DYNAMIC_DISPATCH(calc_patch_damping_matrix)(elements, law, scale, x, rows);
}

}  // namespace flexcast
#endif
