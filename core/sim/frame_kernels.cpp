// Compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/sim/frame_kernels.cpp"
#include <hwy/foreach_target.h>  // before highway.h
// clang-format off
#include <hwy/highway.h>
// clang-format on
#include "core/sim/frame_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
constexpr std::int64_t lanes = hn::MaxLanes(Doubles());
constexpr bool plain = HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128;

void convert_to_floats(const double* numbers, std::int64_t count, float* floats) {
  const Doubles d;
  const hn::Rebind<float, Doubles> f;
  std::int64_t i = 0;
  if (!plain) {  // there DemoteTo makes the largest float of what is larger, not infinity
    for (; i + lanes <= count; i += lanes) hn::StoreU(hn::DemoteTo(f, hn::LoadU(d, numbers + i)), f, floats + i);
  }
  for (; i < count; ++i) floats[i] = static_cast<float>(numbers[i]);
}

HWY_INLINE void widen(double position, double& low, double& high) {
  if (position < low) low = position;
  if (position > high) high = position;
}

// Three vectors go round the axes: lane k of them belongs to axis k mod 3.
void widen_bounds(const double* positions, std::int64_t count, double* low, double* high) {
  const Doubles d;
  constexpr std::int64_t round = 3 * lanes;
  std::int64_t i = 0;
  if (count >= round) {
    auto low0 = hn::LoadU(d, positions), low1 = hn::LoadU(d, positions + lanes);
    auto low2 = hn::LoadU(d, positions + 2 * lanes);
    auto high0 = low0, high1 = low1, high2 = low2;
    for (i = round; i + round <= count; i += round) {
      const auto x0 = hn::LoadU(d, positions + i), x1 = hn::LoadU(d, positions + i + lanes);
      const auto x2 = hn::LoadU(d, positions + i + 2 * lanes);
      low0 = hn::Min(low0, x0), low1 = hn::Min(low1, x1), low2 = hn::Min(low2, x2);
      high0 = hn::Max(high0, x0), high1 = hn::Max(high1, x1), high2 = hn::Max(high2, x2);
    }
    HWY_ALIGN double lows[round], highs[round];
    hn::Store(low0, d, lows), hn::Store(low1, d, lows + lanes), hn::Store(low2, d, lows + 2 * lanes);
    hn::Store(high0, d, highs), hn::Store(high1, d, highs + lanes), hn::Store(high2, d, highs + 2 * lanes);
    for (std::int64_t k = 0; k < round; ++k) {
      widen(lows[k], low[k % 3], high[k % 3]);
      widen(highs[k], low[k % 3], high[k % 3]);
    }
  }
  for (; i < count; ++i) widen(positions[i], low[i % 3], high[i % 3]);
  for (int axis = 0; axis < 3; ++axis) {  // -0 + 0 is +0: which zero was met first depends on the lanes
    low[axis] += 0.0;
    high[axis] += 0.0;
  }
}

// q + 0.5 is cut off, not rounded.
template <class D>
HWY_INLINE void quantize_lanes(D d, const double* positions, const double* low, const double* extent,
                               std::uint16_t* fractions) {
  const auto size = hn::LoadU(d, extent);
  const auto fraction = hn::Div(hn::Sub(hn::LoadU(d, positions), hn::LoadU(d, low)), size);
  const auto scaled = hn::Add(hn::Mul(fraction, hn::Set(d, 65535.0)), hn::Set(d, 0.5));
  const auto some = hn::IfThenElseZero(hn::Gt(size, hn::Zero(d)), scaled);
  const hn::Rebind<std::int32_t, D> whole;
  const hn::Rebind<std::uint16_t, D> narrow;
  hn::StoreU(hn::DemoteTo(narrow, hn::DemoteTo(whole, some)), narrow, fractions);
}

void quantize(const double* positions, std::int64_t count, const double* low, const double* high,
              std::uint16_t* fractions) {
  constexpr std::int64_t round = 3 * lanes;
  double lows[round], extents[round];
  for (std::int64_t k = 0; k < round; ++k) {
    lows[k] = low[k % 3];
    extents[k] = high[k % 3] - low[k % 3];
  }
  std::int64_t i = 0;
  for (; i + round <= count; i += round) {
    for (std::int64_t k = 0; k < round; k += lanes) {
      quantize_lanes(Doubles(), positions + i + k, lows + k, extents + k, fractions + i + k);
    }
  }
  for (std::int64_t k = 0; i < count; ++i, ++k) {
    quantize_lanes(hn::CappedTag<double, 1>(), positions + i, lows + k, extents + k, fractions + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(convert_to_floats);
HWY_EXPORT(widen_bounds);
HWY_EXPORT(quantize);

void convert_to_floats(const double* numbers, std::int64_t count, float* floats) {
  HWY_DYNAMIC_DISPATCH(convert_to_floats)(numbers, count, floats);
}
void widen_bounds(const double* positions, std::int64_t count, double* low, double* high) {
  HWY_DYNAMIC_DISPATCH(widen_bounds)(positions, count, low, high);
}
void quantize(const double* positions, std::int64_t count, const double* low, const double* high,
              std::uint16_t* fractions) {
  HWY_DYNAMIC_DISPATCH(quantize)(positions, count, low, high, fractions);
}

}  // namespace flexcast
#endif
