#include "core/forces/spring_block_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/forces/spring_block_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include "core/base/simd-inl.h"
#include "core/forces/block_sums-inl.h"
#include "core/forces/spring_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

struct SpringRow {
  const std::int32_t* others;
  Real rest_length, inverse_rest_length;

  HWY_INLINE SpringRow(const SpringRows& springs, std::int64_t row, int part)
      : others(springs.others + row * batch_lanes + part),
        rest_length(load(springs.rest + row * 2 * batch_lanes + part)),
        inverse_rest_length(load(springs.rest + (row * 2 + 1) * batch_lanes + part)) {}
};

void add_spring_blocks(const SpringRows& springs, const BlockGroup* groups, std::int64_t count, double k_s,
                       const double* x, double* f, double* K) {
  const auto zero = hn::Zero(Lanes());
  for (const BlockGroup* group = groups; group != groups + count; ++group) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const Vec mine = load_nodes(x, group->particles + part);
      BlockSums sums;
      for (std::int64_t row = group->first_row; row < group->first_row + group->rows; ++row) {
        const SpringRow spring(springs, row, part);
        const auto [n, l] = calc_direction(load_nodes(x, spring.others) - mine);
        const Real stretch = (l - spring.rest_length) * spring.inverse_rest_length;
        sums.subtract(Real(-k_s) * stretch, n);
        // Coincident ends: the axial stiffness along all axes.
        const Real axial = Real(k_s) * spring.inverse_rest_length;
        const Real cut = max(Real(k_s) * stretch / l, zero);
        const Real transverse = hn::IfThenElse(hn::Gt(l.v, zero), cut.v, axial.v);
        sums.add(Real(1.0), add_to_diagonal(outer((axial - transverse) * n, n), transverse));
      }
      sums.put(*group, part, f, K);
    }
  }
}

void add_spring_damping_blocks(const SpringRows& springs, const BlockGroup* groups, std::int64_t count, double k_d,
                               double scale, const double* x, const double* v, double* f, double* K) {
  for (const BlockGroup* group = groups; group != groups + count; ++group) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const Vec my_x = load_nodes(x, group->particles + part), my_v = load_nodes(v, group->particles + part);
      BlockSums sums;
      for (std::int64_t row = group->first_row; row < group->first_row + group->rows; ++row) {
        const SpringRow spring(springs, row, part);
        const Vec n = calc_direction(load_nodes(x, spring.others) - my_x).n;
        const Real damping = Real(k_d) * spring.inverse_rest_length;
        sums.subtract(damping * dot(my_v - load_nodes(v, spring.others), n), n);
        sums.add(Real(scale) * damping, outer(n, n));
      }
      sums.put(*group, part, f, K);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(add_spring_blocks);
HWY_EXPORT(add_spring_damping_blocks);

void add_spring_blocks(const SpringRows& springs, const BlockGroup* groups, std::int64_t count, double k_s,
                       const double* x, double* f, double* K) {
  HWY_DYNAMIC_DISPATCH(add_spring_blocks)(springs, groups, count, k_s, x, f, K);
}

void add_spring_damping_blocks(const SpringRows& springs, const BlockGroup* groups, std::int64_t count, double k_d,
                               double scale, const double* x, const double* v, double* f, double* K) {
  HWY_DYNAMIC_DISPATCH(add_spring_damping_blocks)(springs, groups, count, k_d, scale, x, v, f, K);
}

}  // namespace flexcast
#endif
