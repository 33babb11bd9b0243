// Compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/integrators/particle_kernels.cpp"
#include <hwy/foreach_target.h>  // before highway.h
// clang-format off
#include <hwy/highway.h>
// clang-format on
#include "core/integrators/particle_kernels.h"
#include "core/state/state.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::int64_t width = 8;  // numbers that are added apart

template <class D>
struct Books {
  hn::Vec<D> work;
  hn::Mask<D> good;  // what was written may be published

  HWY_INLINE Books() : work(hn::Zero(D())), good(hn::Eq(work, work)) {}

  // Comparisons with what is not a number are false.
  HWY_INLINE void look_at(hn::Vec<D> value) {
    good = hn::And(good, hn::Le(hn::Abs(value), hn::Set(D(), largest_magnitude)));
  }
};

// pass.run(d, i, books) for every number, a vector at a time while eight are left; then one by one.
template <class Pass>
HWY_INLINE double run_pass(const Pass& pass, std::int64_t first, std::int64_t end) {
  using D = hn::CappedTag<double, width>;
  using One = hn::CappedTag<double, 1>;
  constexpr std::int64_t lanes = hn::MaxLanes(D());
  Books<D> books[width / lanes];
  std::int64_t i = first;
  for (; i + width <= end; i += width) {
    for (std::int64_t k = 0; k < width; k += lanes) pass.run(D(), i + k, books[k / lanes]);
  }
  HWY_ALIGN double work[width];
  bool good = true;
  for (std::int64_t k = 0; k < width; k += lanes) {
    hn::Store(books[k / lanes].work, D(), work + k);
    good &= hn::AllTrue(D(), books[k / lanes].good);
  }
  for (std::int64_t k = 0; i < end; ++i, ++k) {
    Books<One> rest;
    pass.run(One(), i, rest);
    work[k] += hn::GetLane(rest.work);
    good &= hn::AllTrue(One(), rest.good);
  }
  const double sum = ((work[0] + work[4]) + (work[2] + work[6])) + ((work[1] + work[5]) + (work[3] + work[7]));
  return good ? sum : __builtin_nan("");
}

enum class Moves { none, before, after };

template <Moves moves>
struct Kick {
  const KickArrays& a;

  template <class D>
  HWY_INLINE void run(D d, std::int64_t i, Books<D>& books) const {
    const auto F = hn::LoadU(d, a.F + i), v0 = hn::LoadU(d, a.v0 + i);
    const auto change = hn::Mul(hn::Set(d, a.kick), hn::Mul(hn::LoadU(d, a.inverse_masses + i), F));
    const auto v1 = hn::Add(v0, change);
    books.work = hn::Add(books.work, hn::Mul(F, hn::Add(v0, v1)));
    books.look_at(v1);
    if constexpr (moves != Moves::none) {
      const auto v = moves == Moves::before ? v0 : v1;
      const auto x1 = hn::Add(hn::LoadU(d, a.x0 + i), hn::Mul(hn::Set(d, a.drift), v));
      books.look_at(x1);
      hn::StoreU(x1, d, a.x1 + i);
    }
    hn::StoreU(v1, d, a.v1 + i);
  }
};

double run_kick(const KickArrays& a, std::int64_t first, std::int64_t end) {
  const double sum = !a.x1                 ? run_pass(Kick<Moves::none>{a}, first, end)
                     : a.by_old_velocities ? run_pass(Kick<Moves::before>{a}, first, end)
                                           : run_pass(Kick<Moves::after>{a}, first, end);
  return 0.5 * a.kick * sum;
}

struct Drift {
  const DriftArrays& a;

  template <class D>
  HWY_INLINE void run(D d, std::int64_t i, Books<D>& books) const {
    const auto x1 = hn::Add(hn::LoadU(d, a.x0 + i), hn::Mul(hn::Set(d, a.drift), hn::LoadU(d, a.v + i)));
    books.look_at(x1);
    hn::StoreU(x1, d, a.x1 + i);
  }
};

double run_drift(const DriftArrays& a, std::int64_t first, std::int64_t end) {
  return run_pass(Drift{a}, first, end);
}

struct Follow {
  const FollowArrays& a;

  template <class D>
  HWY_INLINE void run(D d, std::int64_t i, Books<D>& books) const {
    const auto u = hn::LoadU(d, a.u + i), v0 = hn::LoadU(d, a.v0 + i);
    const auto x1 = hn::Add(hn::LoadU(d, a.base + i), hn::Mul(hn::Set(d, a.reach), u));
    const auto moved = hn::Sub(hn::Div(u, hn::Set(d, a.time)), hn::Mul(hn::Set(d, a.past), v0));
    const auto held = hn::Eq(hn::LoadU(d, a.free + i), hn::Zero(d));
    const auto v1 = hn::IfThenElse(held, v0, moved);
    const auto impulse = hn::Mul(hn::LoadU(d, a.masses + i), hn::Sub(v1, v0));
    books.work = hn::Add(books.work, hn::Mul(impulse, hn::Add(v0, v1)));
    books.look_at(x1);
    books.look_at(v1);
    hn::StoreU(x1, d, a.x1 + i);
    hn::StoreU(v1, d, a.v1 + i);
  }
};

double run_follow(const FollowArrays& a, std::int64_t first, std::int64_t end) {
  return 0.5 * run_pass(Follow{a}, first, end);
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(run_kick);
HWY_EXPORT(run_drift);
HWY_EXPORT(run_follow);

double run_kick(const KickArrays& arrays, std::int64_t first, std::int64_t end) {
  return HWY_DYNAMIC_DISPATCH(run_kick)(arrays, first, end);
}
double run_drift(const DriftArrays& arrays, std::int64_t first, std::int64_t end) {
  return HWY_DYNAMIC_DISPATCH(run_drift)(arrays, first, end);
}
double run_follow(const FollowArrays& arrays, std::int64_t first, std::int64_t end) {
  return HWY_DYNAMIC_DISPATCH(run_follow)(arrays, first, end);
}

}  // namespace flexcast
#endif
