#include "core/forces/tetrahedra_block_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/forces/tetrahedra_block_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include "core/base/simd-inl.h"
#include "core/forces/block_sums-inl.h"
#include "core/forces/element_lanes-inl.h"
#include "core/forces/kelvin_voigt-inl.h"
#include "core/materials/corotational-inl.h"
#include "core/materials/linear-inl.h"
#include "core/materials/neo_hookean-inl.h"
#include "core/materials/st_venant_kirchhoff-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

// One row of a group, the lanes from `part` on; node number `own` is the lane's particle.
template <class Shape, int own>
struct RowLanes {
  const std::int32_t* nodes;
  Mat inverse_edges;
  Real weight;

  HWY_INLINE RowLanes(const ElementRows& elements, std::int64_t row, int part)
      : nodes(elements.nodes + row * (Shape::nodes - 1) * batch_lanes + part),
        inverse_edges(load_mat(elements.rest + row * 10 * batch_lanes + part)),
        weight(load(elements.rest + (row * 10 + 9) * batch_lanes + part)) {
    if (part != 0) return;
    // Rows are read in their order, once a sweep: the ones to come are asked for early, as pages end too soon for the
    // processor to see that by itself.
    constexpr int ahead = 4;
    for (int k = 0; k < 10; ++k) hwy::Prefetch(elements.rest + ((row + ahead) * 10 + k) * batch_lanes);
    constexpr int numbers = (Shape::nodes - 1) * batch_lanes;
    for (int k = 0; k < numbers; k += 16) hwy::Prefetch(elements.nodes + (row + ahead) * numbers + k);
  }

  HWY_INLINE typename Shape::Motion load_motion(const Vec& mine, const double* vectors) const {
    Vec x[Shape::nodes];
    x[own] = mine;
    for (int a = 0; a < Shape::nodes; ++a) {
      if (a != own) x[a] = load_nodes(vectors, nodes + (a - (a > own)) * batch_lanes);
    }
    return Shape::make_motion(x);
  }
  HWY_INLINE Mat calc_gradient(const typename Shape::Motion& motion, int q) const {
    return Shape::calc_derivative(motion, q) * inverse_edges;
  }
  HWY_INLINE Vec calc_shape_gradient(int q) const {
    const Mat rows = transpose(inverse_edges);
    const Vec grad_L[4] = {Real(-1.0) * (rows.c0 + rows.c1 + rows.c2), rows.c0, rows.c1, rows.c2};
    return Shape::calc_shape_gradient(grad_L, q, own);
  }
};

template <class Kernel>
HWY_INLINE Mat calc_own_block(const Kernel& kernel, const Mat& F, const Vec& g) {
  const auto point = kernel.template calc_point<false>(F);
  const auto node = kernel.calc_node(point, g);
  return kernel.calc_block(point, node, node);
}

template <class Kernel>
HWY_INLINE void add_own(const Kernel& kernel, const Mat& F, const Vec& g, Real weight, BlockSums& sums) {
  sums.subtract(weight, kernel.calc_stress(F) * g);
  sums.add(weight, calc_own_block(kernel, F, g));
}
HWY_INLINE void add_own(const CorotationalKernel& kernel, const Mat& F, const Vec& g, Real weight, BlockSums& sums) {
  Vec slope;
  Mat block;
  kernel.calc_own(F, g, slope, block);
  sums.subtract(weight, slope);
  sums.add(weight, block);
}

template <class Shape, int own>
struct AddBlocks {
  template <class Kernel>
  static void run(const ElementRows& elements, const Kernel& kernel, const BlockGroup& group, const double* x,
                  double* f, double* K) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const Vec mine = load_nodes(x, group.particles + part);
      BlockSums sums;
      for (std::int64_t row = group.first_row; row < group.first_row + group.rows; ++row) {
        const RowLanes<Shape, own> element(elements, row, part);
        const auto motion = element.load_motion(mine, x);
        for (int q = 0; q < Shape::points; ++q) {
          add_own(kernel, element.calc_gradient(motion, q), element.calc_shape_gradient(q), element.weight, sums);
        }
      }
      sums.put(group, part, f, K);
    }
  }
};

template <class Shape, int own>
struct AddDampingBlocks {
  template <class Kernel>
  static void run(const ElementRows& elements, const Kernel& kernel, const BlockGroup& group, const double* x,
                  const double* v, double scale, double* f, double* K) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const Vec my_x = load_nodes(x, group.particles + part), my_v = load_nodes(v, group.particles + part);
      BlockSums sums;
      for (std::int64_t row = group.first_row; row < group.first_row + group.rows; ++row) {
        const RowLanes<Shape, own> element(elements, row, part);
        const auto motion = element.load_motion(my_x, x), rates = element.load_motion(my_v, v);
        for (int q = 0; q < Shape::points; ++q) {
          const Mat F = element.calc_gradient(motion, q);
          const Vec g = element.calc_shape_gradient(q);
          sums.subtract(element.weight, kernel.calc_stress(F, element.calc_gradient(rates, q)) * g);
          sums.add(Real(scale) * element.weight, calc_own_block(kernel, F, g));
        }
      }
      sums.put(group, part, f, K);
    }
  }
};

template <template <class, int> class Loop, class Kernel, class... Arguments>
HWY_INLINE void for_groups(const ElementRows& elements, const Kernel& kernel, const BlockGroup* groups,
                           std::int64_t count, Arguments... arguments) {
  for (std::int64_t k = 0; k < count; ++k) {
    if (!elements.quadratic) {
      Loop<LinearLanes, 1>::run(elements, kernel, groups[k], arguments...);
    } else if (groups[k].kind == 0) {
      Loop<QuadraticLanes, 1>::run(elements, kernel, groups[k], arguments...);
    } else {
      Loop<QuadraticLanes, 4>::run(elements, kernel, groups[k], arguments...);
    }
  }
}

void add_element_blocks(const ElementRows& elements, const BlockGroup* groups, std::int64_t count,
                        const ElementLaw& law, const double* x, double* f, double* K) {
  const Real mu = law.lame.mu, lambda = law.lame.lambda;
  const auto run = [&](const auto& kernel)
                       HWY_ATTR { for_groups<AddBlocks>(elements, kernel, groups, count, x, f, K); };
  switch (law.law->kernel) {
    case LawKernel::linear:
      return run(LinearKernel{mu, lambda});
    case LawKernel::corotational:
      return run(CorotationalKernel{mu, lambda, law.lame.mu, law.lame.lambda});
    case LawKernel::st_venant_kirchhoff:
      return run(StVenantKirchhoffKernel{mu, lambda});
    case LawKernel::neo_hookean:
      return run(NeoHookeanKernel{mu, lambda});
    case LawKernel::none:
      return;
  }
}

void add_element_damping_blocks(const ElementRows& elements, const BlockGroup* groups, std::int64_t count,
                                const ElementLaw& law, double scale, const double* x, const double* v, double* f,
                                double* K) {
  const Real mu = law.viscosity.mu, lambda = law.viscosity.lambda;
  if (law.small_strain) {
    for_groups<AddDampingBlocks>(elements, SmallKelvinVoigtKernel{{mu, lambda}}, groups, count, x, v, scale, f, K);
  } else {
    for_groups<AddDampingBlocks>(elements, KelvinVoigtKernel{mu, lambda}, groups, count, x, v, scale, f, K);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(add_element_blocks);
HWY_EXPORT(add_element_damping_blocks);

void add_element_blocks(const ElementRows& elements, const BlockGroup* groups, std::int64_t count,
                        const ElementLaw& law, const double* x, double* f, double* K) {
  HWY_DYNAMIC_DISPATCH(add_element_blocks)(elements, groups, count, law, x, f, K);
}

void add_element_damping_blocks(const ElementRows& elements, const BlockGroup* groups, std::int64_t count,
                                const ElementLaw& law, double scale, const double* x, const double* v, double* f,
                                double* K) {
  HWY_DYNAMIC_DISPATCH(add_element_damping_blocks)(elements, groups, count, law, scale, x, v, f, K);
}

}  // namespace flexcast
#endif
