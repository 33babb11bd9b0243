#include "core/base/block_product.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/base/block_product.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

#if HWY_MAX_BYTES >= 32

// Four lanes whatever the registers hold, so that the same bits come out. The fourth is another column's: nobody
// reads what becomes of it. One sum a column, so that no product waits for the one before.
double multiply_rows(const BlockRows& A, std::int64_t first, std::int64_t end, const double* x, double* y) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::FixedTag<double, 4> d;
  double dot = 0.0;
  for (std::int64_t i = first; i < end; ++i) {
    auto sum0 = hn::Zero(d), sum1 = hn::Zero(d), sum2 = hn::Zero(d);
    const std::int64_t row_end = A.starts[i + 1];
    for (std::int64_t k = A.starts[i]; k < row_end; ++k) {
      const double* block = A.values + 9 * k;
      const double* xj = x + 3 * static_cast<std::int64_t>(A.columns[k]);
      sum0 = hn::MulAdd(hn::LoadU(d, block), hn::Set(d, xj[0]), sum0);
      sum1 = hn::MulAdd(hn::LoadU(d, block + 3), hn::Set(d, xj[1]), sum1);
      sum2 = hn::MulAdd(hn::LoadU(d, block + 6), hn::Set(d, xj[2]), sum2);
    }
    HWY_ALIGN double sum[4];
    hn::Store(hn::Add(hn::Add(sum0, sum1), sum2), d, sum);
    const double* xi = x + 3 * i;
    double* yi = y + 3 * i;
    yi[0] = sum[0];
    yi[1] = sum[1];
    yi[2] = sum[2];
    dot += (sum[0] * xi[0] + sum[1] * xi[1]) + sum[2] * xi[2];
  }
  return dot;
}

#else

double multiply_rows(const BlockRows& A, std::int64_t first, std::int64_t end, const double* x, double* y) {
  double dot = 0.0;
  for (std::int64_t i = first; i < end; ++i) {
    double sum[3] = {0.0, 0.0, 0.0};
    for (std::int64_t k = A.starts[i]; k < A.starts[i + 1]; ++k) {
      const double* block = A.values + 9 * k;
      const double* xj = x + 3 * static_cast<std::int64_t>(A.columns[k]);
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) sum[r] += block[3 * c + r] * xj[c];
      }
    }
    for (int r = 0; r < 3; ++r) {
      y[3 * i + r] = sum[r];
      dot += sum[r] * x[3 * i + r];
    }
  }
  return dot;
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(multiply_rows);

double multiply_block_rows(const BlockRows& A, std::int64_t first, std::int64_t end, const double* x, double* y) {
  return HWY_DYNAMIC_DISPATCH(multiply_rows)(A, first, end, x, y);
}

}  // namespace flexcast
#endif
