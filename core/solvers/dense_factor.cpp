#include "core/solvers/dense_factor.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solvers/dense_factor.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_MAX_BYTES >= 32
using Lanes = hn::FixedTag<double, 4>;
#else
using Lanes = hn::FixedTag<double, 1>;
#endif
using OneLane = hn::FixedTag<double, 1>;

// to -= a from for entries [first, end).
HWY_INLINE void subtract(const double* from, double a, double* to, int first, int end) {
  const Lanes d;
  const OneLane one;
  int i = first;
  for (; i + static_cast<int>(hn::Lanes(d)) <= end; i += static_cast<int>(hn::Lanes(d))) {
    hn::StoreU(hn::NegMulAdd(hn::Set(d, a), hn::LoadU(d, from + i), hn::LoadU(d, to + i)), d, to + i);
  }
  for (; i < end; ++i) {
    hn::StoreU(hn::NegMulAdd(hn::Set(one, a), hn::LoadU(one, from + i), hn::LoadU(one, to + i)), one, to + i);
  }
}

HWY_INLINE double dot(const double* a, const double* b, int first, int end) {
  const Lanes d;
  const OneLane one;
  auto sum = hn::Zero(d);
  auto rest = hn::Zero(one);
  int i = first;
  for (; i + static_cast<int>(hn::Lanes(d)) <= end; i += static_cast<int>(hn::Lanes(d))) {
    sum = hn::MulAdd(hn::LoadU(d, a + i), hn::LoadU(d, b + i), sum);
  }
  for (; i < end; ++i) rest = hn::MulAdd(hn::LoadU(one, a + i), hn::LoadU(one, b + i), rest);
  return hn::GetLane(hn::SumOfLanes(d, sum)) + hn::GetLane(rest);
}

void factor(double* A, int n, double* entries) {
  constexpr double rounding = 1e-13;
  for (int k = 0; k < n; ++k) entries[k] = A[k * n + k];
  for (int k = 0; k < n; ++k) {
    double* column = A + k * n;
    const double pivot = column[k];
    const double inverse = pivot > rounding * entries[k] ? 1.0 / pivot : 0.0;
    for (int j = k + 1; j < n; ++j) {
      const double factor_jk = column[j] * inverse;
      if (factor_jk != 0.0) subtract(column, factor_jk, A + j * n, j, n);
    }
    for (int j = k + 1; j < n; ++j) column[j] *= inverse;
    column[k] = inverse;
  }
}

void solve(const double* A, int n, double* x) {
  for (int k = 0; k < n; ++k) subtract(A + k * n, x[k], x, k + 1, n);
  for (int k = n - 1; k >= 0; --k) x[k] = A[k * n + k] == 0.0 ? 0.0 : x[k] * A[k * n + k] - dot(A + k * n, x, k + 1, n);
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(factor);
HWY_EXPORT(solve);

void factor_dense(double* A, int n, double* scratch) {
  HWY_DYNAMIC_DISPATCH(factor)(A, n, scratch);
}

void solve_dense(const double* A, int n, double* x) {
  HWY_DYNAMIC_DISPATCH(solve)(A, n, x);
}

}  // namespace flexcast
#endif
