#include "core/solvers/pcg_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solvers/pcg_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Four lanes where there are four, whatever more the registers hold: the same bits with AVX2 and AVX-512.
#if HWY_MAX_BYTES >= 32
using Lanes = hn::FixedTag<double, 4>;
#else
using Lanes = hn::FixedTag<double, 1>;
#endif
using OneLane = hn::FixedTag<double, 1>;

template <class D>
HWY_INLINE void advance(D d, const PcgVectors& v, double alpha, std::int64_t i, hn::Vec<D>& rr) {
  const auto a = hn::Set(d, alpha);
  hn::StoreU(hn::MulAdd(a, hn::LoadU(d, v.p + i), hn::LoadU(d, v.x + i)), d, v.x + i);
  const auto r = hn::NegMulAdd(a, hn::LoadU(d, v.Ap + i), hn::LoadU(d, v.r + i));
  hn::StoreU(r, d, v.r + i);
  rr = hn::MulAdd(r, r, rr);
}

HWY_INLINE double apply_block(const double* block, const double* r, double* z) {
  double sum[4];
#if HWY_MAX_BYTES >= 32
  const Lanes d;
  auto s = hn::Mul(hn::LoadU(d, block), hn::Set(d, r[0]));
  s = hn::MulAdd(hn::LoadU(d, block + 3), hn::Set(d, r[1]), s);
  s = hn::MulAdd(hn::LoadU(d, block + 6), hn::Set(d, r[2]), s);
  hn::StoreU(s, d, sum);
#else
  for (int k = 0; k < 3; ++k) sum[k] = (block[k] * r[0] + block[k + 3] * r[1]) + block[k + 6] * r[2];
#endif
  z[0] = sum[0];
  z[1] = sum[1];
  z[2] = sum[2];
  return (sum[0] * r[0] + sum[1] * r[1]) + sum[2] * r[2];
}

PcgSums advance_some(const PcgVectors& v, double alpha, std::int64_t first, std::int64_t end) {
  constexpr std::int64_t step = 128;  // rows that stay in the first cache between the two loops
  const Lanes d;
  const OneLane one;
  PcgSums sums;
  auto rr = hn::Zero(d);
  auto rest = hn::Zero(one);
  for (std::int64_t from = first; from < end; from += step) {
    const std::int64_t to = from + step < end ? from + step : end;
    std::int64_t i = 3 * from;
    for (; i + static_cast<std::int64_t>(hn::Lanes(d)) <= 3 * to; i += static_cast<std::int64_t>(hn::Lanes(d))) {
      advance(d, v, alpha, i, rr);
    }
    for (; i < 3 * to; ++i) advance(one, v, alpha, i, rest);
    if (v.inverse_blocks == nullptr) continue;
    for (std::int64_t row = from; row < to; ++row) {
      sums.rz += apply_block(v.inverse_blocks + 9 * row, v.r + 3 * row, v.z + 3 * row);
    }
  }
  sums.rr = hn::GetLane(hn::SumOfLanes(d, rr)) + hn::GetLane(rest);
  return sums;
}

void turn_some(const double* z, double beta, double* p, std::int64_t first, std::int64_t end) {
  const Lanes d;
  const OneLane one;
  std::int64_t i = first;
  for (; i + static_cast<std::int64_t>(hn::Lanes(d)) <= end; i += static_cast<std::int64_t>(hn::Lanes(d))) {
    hn::StoreU(hn::MulAdd(hn::Set(d, beta), hn::LoadU(d, p + i), hn::LoadU(d, z + i)), d, p + i);
  }
  for (; i < end; ++i) {
    hn::StoreU(hn::MulAdd(hn::Set(one, beta), hn::LoadU(one, p + i), hn::LoadU(one, z + i)), one, p + i);
  }
}

double dot_some(const double* a, const double* b, std::int64_t first, std::int64_t end) {
  const Lanes d;
  const OneLane one;
  auto sum = hn::Zero(d);
  auto rest = hn::Zero(one);
  std::int64_t i = first;
  for (; i + static_cast<std::int64_t>(hn::Lanes(d)) <= end; i += static_cast<std::int64_t>(hn::Lanes(d))) {
    sum = hn::MulAdd(hn::LoadU(d, a + i), hn::LoadU(d, b + i), sum);
  }
  for (; i < end; ++i) rest = hn::MulAdd(hn::LoadU(one, a + i), hn::LoadU(one, b + i), rest);
  return hn::GetLane(hn::SumOfLanes(d, sum)) + hn::GetLane(rest);
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(advance_some);
HWY_EXPORT(turn_some);
HWY_EXPORT(dot_some);

PcgSums advance_rows(const PcgVectors& vectors, double alpha, std::int64_t first, std::int64_t end) {
  return HWY_DYNAMIC_DISPATCH(advance_some)(vectors, alpha, first, end);
}

void turn_direction(const double* z, double beta, double* p, std::int64_t first, std::int64_t end) {
  HWY_DYNAMIC_DISPATCH(turn_some)(z, beta, p, first, end);
}

double dot_entries(const double* a, const double* b, std::int64_t first, std::int64_t end) {
  return HWY_DYNAMIC_DISPATCH(dot_some)(a, b, first, end);
}

}  // namespace flexcast
#endif
