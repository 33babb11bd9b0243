#include "core/forces/spring_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/forces/spring_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include "core/base/simd-inl.h"
#include "core/forces/spring_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

struct SpringLanes {
  const std::uint16_t* places;
  Real rest_length, inverse_rest_length;

  HWY_INLINE SpringLanes(const SpringBatches& springs, int b, int part)
      : places(springs.places + static_cast<std::int64_t>(b) * 2 * batch_lanes + part),
        rest_length(load(springs.rest_lengths + static_cast<std::int64_t>(b) * batch_lanes + part)),
        inverse_rest_length(load(springs.inverse_rest_lengths + static_cast<std::int64_t>(b) * batch_lanes + part)) {}

  HWY_INLINE Vec calc_difference(const double* vectors) const {
    return load_nodes(vectors, places + batch_lanes) - load_nodes(vectors, places);
  }
};

void calc_spring_forces(const SpringBatches& springs, double k_s, const double* x, double* rows) {
  for (int b = 0; b < springs.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const SpringLanes spring(springs, b, part);
      const Direction direction = calc_direction(spring.calc_difference(x));
      const Real stretch = (direction.l - spring.rest_length) * spring.inverse_rest_length;
      store_rows((Real(k_s) * stretch) * direction.n, rows + (b * batch_lanes + part) * 4);
    }
  }
}

double calc_damped_spring_forces(const SpringBatches& springs, double k_s, double k_d, const double* x, const double* v,
                                 double* rows) {
  LaneSums power;
  for (int b = 0; b < springs.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const SpringLanes spring(springs, b, part);
      const Direction direction = calc_direction(spring.calc_difference(x));
      const Real rate = dot(spring.calc_difference(v), direction.n);
      const Real stretch = (direction.l - spring.rest_length) * spring.inverse_rest_length;
      const Real damping = Real(k_d) * rate * spring.inverse_rest_length;
      power.add(part, damping * rate);
      store_rows(fma(Real(k_s), stretch, damping) * direction.n, rows + (b * batch_lanes + part) * 4);
    }
  }
  return power.total();
}

double calc_spring_energy(const SpringBatches& springs, double k_s, const double* x) {
  LaneSums energy;
  for (int b = 0; b < springs.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const SpringLanes spring(springs, b, part);
      const Real extension = calc_direction(spring.calc_difference(x)).l - spring.rest_length;
      energy.add(part, Real(0.5 * k_s) * spring.inverse_rest_length * extension * extension);
    }
  }
  return energy.total();
}

void sweep_spring_constraints(const SpringBatches& springs, const SpringSweep& sweep) {
  for (int b = 0; b < springs.count; ++b) {
    for (int part = 0; part < batch_lanes; part += lane_count) {
      const SpringLanes spring(springs, b, part);
      const Vec moved = spring.calc_difference(sweep.u);
      const Direction direction = calc_direction(spring.calc_difference(sweep.start) + moved);
      const Vec& n = direction.n;
      const Vec w_p = load_nodes(sweep.inverse_masses, spring.places);
      const Vec w_q = load_nodes(sweep.inverse_masses, spring.places + batch_lanes);
      const Vec move_p{w_p.x * n.x, w_p.y * n.y, w_p.z * n.z}, move_q{w_q.x * n.x, w_q.y * n.y, w_q.z * n.z};
      const Real s = Real(sweep.h * sweep.h * sweep.k_s) * spring.inverse_rest_length;
      const Real s_d = Real(sweep.h * sweep.k_d) * spring.inverse_rest_length;
      const Real W = dot(n, move_p) + dot(n, move_q);
      double* lambdas = sweep.lambda + static_cast<std::int64_t>(b) * batch_lanes + part;
      const Real lambda = load_unaligned(lambdas);
      const Real extension = direction.l - spring.rest_length;
      const Real change = (-(s * extension) - lambda - s_d * dot(n, moved)) / fma(s + s_d, W, Real(1.0));
      store_unaligned(lambda + change, lambdas);
      const Vec moves[2] = {(-change) * move_p, change * move_q};
      add_to_nodes(moves, spring.places, sweep.u);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(calc_spring_forces);
HWY_EXPORT(calc_damped_spring_forces);
HWY_EXPORT(calc_spring_energy);
HWY_EXPORT(sweep_spring_constraints);

void calc_spring_forces(const SpringBatches& springs, double k_s, const double* x, double* rows) {
  HWY_DYNAMIC_DISPATCH(calc_spring_forces)(springs, k_s, x, rows);
}

double calc_damped_spring_forces(const SpringBatches& springs, double k_s, double k_d, const double* x, const double* v,
                                 double* rows) {
  return HWY_DYNAMIC_DISPATCH(calc_damped_spring_forces)(springs, k_s, k_d, x, v, rows);
}

double calc_spring_energy(const SpringBatches& springs, double k_s, const double* x) {
  return HWY_DYNAMIC_DISPATCH(calc_spring_energy)(springs, k_s, x);
}

void sweep_spring_constraints(const SpringBatches& springs, const SpringSweep& sweep) {
  HWY_DYNAMIC_DISPATCH(sweep_spring_constraints)(springs, sweep);
}

}  // namespace flexcast
#endif
