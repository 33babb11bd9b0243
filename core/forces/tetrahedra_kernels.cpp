#include "core/forces/tetrahedra_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/forces/tetrahedra_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include "core/base/simd-inl.h"
#include "core/forces/element_lanes-inl.h"
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
  HWY_INLINE Real calc_energy_and_stress(const Mat& F, Mat& P) const {
    P = calc_stress(F);
    return calc_energy(F);
  }
};

// Kelvin-Voigt damping. Its matrix is that of St. Venant-Kirchhoff without the part of the present stress.
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

template <class Shape, class Kernel>
void add_forces(const ElementBatches& elements, const Kernel& kernel, const double* x, double* f) {
  for (int b = 0; b < elements.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const ElementLanes<Shape> element(elements, b, part);
      const auto motion = element.load_motion(x);
      typename Shape::Slopes slopes;
      for (int q = 0; q < Shape::points; ++q) {
        slopes.add(q, element.calc_point_slopes(kernel.calc_stress(element.calc_gradient(motion, q))));
      }
      element.subtract(slopes, f);
    }
  }
}

template <class Shape, class Kernel>
double calc_energy(const ElementBatches& elements, const Kernel& kernel, const double* x) {
  LaneSums sums;
  for (int b = 0; b < elements.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const ElementLanes<Shape> element(elements, b, part);
      const auto motion = element.load_motion(x);
      for (int q = 0; q < Shape::points; ++q) {
        sums.add(part, element.weight * kernel.calc_energy(element.calc_gradient(motion, q)));
      }
    }
  }
  return sums.total();
}

template <class Shape, class Kernel>
double add_damping(const ElementBatches& elements, const Kernel& kernel, const double* x, const double* v, double* f) {
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
      element.subtract(slopes, f);
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
      Real U = 0.0;
      typename Shape::Slopes slopes;
      for (int q = 0; q < Shape::points; ++q) {
        Mat P;
        U = fma(element.weight, kernel.calc_energy_and_stress(element.calc_gradient(motion, q), P), U);
        slopes.add(q, element.calc_point_slopes(P));
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

// Blocks of the nodes a <= b; those below the diagonal are their transposes.
template <bool clamped, class Shape, class Kernel>
void add_stiffness(const ElementBatches& elements, const Kernel& kernel, double scale, const double* x,
                   const std::int32_t* entries, double* values) {
  constexpr int n = Shape::nodes;
  for (int b = 0; b < elements.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const std::int32_t* to = entries + static_cast<std::int64_t>(b) * n * n * batch_lanes + part;
      const ElementLanes<Shape> element(elements, b, part);
      const auto motion = element.load_motion(x);
      const Real weight = Real(scale) * element.weight;
      typename Kernel::Point points[Shape::points];
      typename Kernel::Node nodes[Shape::points][n];
      for (int q = 0; q < Shape::points; ++q) {
        points[q] = kernel.template calc_point<clamped>(element.calc_gradient(motion, q));
        for (int a = 0; a < n; ++a) nodes[q][a] = kernel.calc_node(points[q], element.calc_shape_gradient(q, a));
      }
      for (int i = 0; i < n; ++i) {
        for (int j = i; j < n; ++j) {
          Mat block = kernel.calc_block(points[0], nodes[0][i], nodes[0][j]);
          for (int q = 1; q < Shape::points; ++q) {
            block = block + kernel.calc_block(points[q], nodes[q][i], nodes[q][j]);
          }
          block = weight * block;
          add_to_blocks(block, to + (i * n + j) * batch_lanes, values);
          if (j != i) add_to_blocks(transpose(block), to + (j * n + i) * batch_lanes, values);
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

struct AddForces {
  const ElementBatches& elements;
  const double* x;
  double* f;
  template <class Shape>
  void run(const auto& kernel) {
    add_forces<Shape>(elements, kernel, x, f);
  }
};

void add_patch_forces(const ElementBatches& elements, const ElementLaw& law, const double* x, double* f) {
  AddForces visit{elements, x, f};
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

struct AddDamping {
  const ElementBatches& elements;
  const double* x;
  const double* v;
  double* f;
  double power = 0.0;
  template <class Shape>
  void run(const auto& kernel) {
    power = add_damping<Shape>(elements, kernel, x, v, f);
  }
};

double add_patch_damping(const ElementBatches& elements, const ElementLaw& law, const double* x, const double* v,
                         double* f) {
  AddDamping visit{elements, x, v, f};
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
struct AddStiffness {
  const ElementBatches& elements;
  double scale;
  const double* x;
  const std::int32_t* entries;
  double* values;
  template <class Shape>
  void run(const auto& kernel) {
    add_stiffness<clamped, Shape>(elements, kernel, scale, x, entries, values);
  }
};

void add_patch_stiffness(const ElementBatches& elements, const ElementLaw& law, Tangent kind, double scale,
                         const double* x, const std::int32_t* entries, double* values) {
  if (kind == Tangent::positive_semidefinite && law.law->kernel == LawKernel::corotational) {
    AddStiffness<true> visit{elements, scale, x, entries, values};
    choose_shape(elements, visit, CorotationalKernel{law.lame.mu, law.lame.lambda, law.lame.mu, law.lame.lambda});
  } else {
    AddStiffness<false> visit{elements, scale, x, entries, values};
    choose_kernel(elements, law, visit);
  }
}

void add_patch_damping_matrix(const ElementBatches& elements, const ElementLaw& law, double scale, const double* x,
                              const std::int32_t* entries, double* values) {
  AddStiffness<false> visit{elements, scale, x, entries, values};
  choose_damping(elements, law, visit);
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(add_patch_forces);
HWY_EXPORT(calc_patch_energy);
HWY_EXPORT(add_patch_damping);
HWY_EXPORT(sweep_patch_constraints);
HWY_EXPORT(add_patch_stiffness);
HWY_EXPORT(add_patch_damping_matrix);

void add_patch_forces(const ElementBatches& elements, const ElementLaw& law, const double* x, double* f) {
  HWY_DYNAMIC_DISPATCH(add_patch_forces)(elements, law, x, f);
}

double calc_patch_energy(const ElementBatches& elements, const ElementLaw& law, const double* x) {
  return HWY_DYNAMIC_DISPATCH(calc_patch_energy)(elements, law, x);
}

double add_patch_damping(const ElementBatches& elements, const ElementLaw& law, const double* x, const double* v,
                         double* f) {
  return HWY_DYNAMIC_DISPATCH(add_patch_damping)(elements, law, x, v, f);
}

void sweep_patch_constraints(const ElementBatches& elements, const ElementLaw& law, const PatchSweep& sweep) {
  HWY_DYNAMIC_DISPATCH(sweep_patch_constraints)(elements, law, sweep);
}

bool has_stiffness_in_lanes(const Law& law, Tangent kind) {
  if (law.kernel == LawKernel::linear || law.kernel == LawKernel::corotational) return true;
  return law.kernel != LawKernel::none && kind == Tangent::exact;
}

void add_patch_stiffness(const ElementBatches& elements, const ElementLaw& law, Tangent kind, double scale,
                         const double* x, const std::int32_t* entries, double* values) {
  HWY_DYNAMIC_DISPATCH(add_patch_stiffness)(elements, law, kind, scale, x, entries, values);
}

void add_patch_damping_matrix(const ElementBatches& elements, const ElementLaw& law, double scale, const double* x,
                              const std::int32_t* entries, double* values) {
  HWY_DYNAMIC_DISPATCH(add_patch_damping_matrix)(elements, law, scale, x, entries, values);
}

}  // namespace flexcast
#endif
