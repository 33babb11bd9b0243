#include "core/solvers/gauss_seidel_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solvers/gauss_seidel_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The three entries of a block row, a sum for each column of the blocks so that products need not wait for another.
#if HWY_MAX_BYTES >= 32
class Row {
 public:
  using Lanes = hn::FixedTag<double, 4>;
  using Vector = hn::Vec<Lanes>;

  // Starts with the three doubles at `from`.
  HWY_INLINE explicit Row(const double* from) { start(load(from)); }
  // Starts with from + a b, entry by entry.
  HWY_INLINE Row(const double* from, const double* a, const double* b) {
    start(hn::MulAdd(load(a), load(b), load(from)));
  }
  HWY_INLINE void subtract(const double* block, const double* x) {
    const Lanes d;
    sum0_ = hn::NegMulAdd(hn::LoadU(d, block), hn::Set(d, x[0]), sum0_);
    sum1_ = hn::NegMulAdd(hn::LoadU(d, block + 3), hn::Set(d, x[1]), sum1_);
    sum2_ = hn::NegMulAdd(hn::LoadU(d, block + 6), hn::Set(d, x[2]), sum2_);
  }
  HWY_INLINE void store(double* to) const { put(sum(), to); }
  // to = block times this.
  HWY_INLINE void store_product(const double* block, double* to) const {
    const Lanes d;
    const Vector y = sum(), low = hn::ConcatLowerLower(d, y, y), high = hn::ConcatUpperUpper(d, y, y);
    const Vector first = hn::Mul(hn::LoadU(d, block), hn::Broadcast<0>(low));
    const Vector second = hn::MulAdd(hn::LoadU(d, block + 3), hn::Broadcast<1>(low), first);
    put(hn::MulAdd(hn::LoadU(d, block + 6), hn::Broadcast<0>(high), second), to);
  }

 private:
  static HWY_INLINE Vector load(const double* from) {
    const Lanes d;
    return hn::MaskedLoad(hn::FirstN(d, 3), d, from);
  }
  HWY_INLINE void start(Vector v) {
    sum0_ = v;
    sum1_ = sum2_ = hn::Zero(Lanes());
  }
  HWY_INLINE Vector sum() const { return hn::Add(hn::Add(sum1_, sum2_), sum0_); }
  static HWY_INLINE void put(Vector v, double* to) {
    const hn::Half<Lanes> half;
    hn::StoreU(hn::LowerHalf(half, v), half, to);
    to[2] = hn::GetLane(hn::UpperHalf(half, v));
  }
  Vector sum0_, sum1_, sum2_;
};
#else
class Row {
 public:
  explicit Row(const double* from) : sum_{from[0], from[1], from[2]} {}
  Row(const double* from, const double* a, const double* b)
      : sum_{from[0] + a[0] * b[0], from[1] + a[1] * b[1], from[2] + a[2] * b[2]} {}
  void subtract(const double* block, const double* x) {
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) sum_[r] -= block[3 * c + r] * x[c];
    }
  }
  void store(double* to) const {
    for (int r = 0; r < 3; ++r) to[r] = sum_[r];
  }
  void store_product(const double* block, double* to) const {
    for (int r = 0; r < 3; ++r) to[r] = block[r] * sum_[0] + block[3 + r] * sum_[1] + block[6 + r] * sum_[2];
  }

 private:
  double sum_[3];
};
#endif

HWY_INLINE const double* at(const double* x, std::int32_t j) {
  return x + 3 * static_cast<std::int64_t>(j);
}

// Half rows, and rows from the last to the first, are not what processors foresee: blocks [first, end) are asked for.
HWY_INLINE void prefetch(const BlockRows& A, std::int64_t first, std::int64_t end) {
  for (const double* p = A.values + 9 * first; p < A.values + 9 * end; p += 8) hwy::Prefetch(p);
}
constexpr std::int64_t ahead = 4;  // rows

void forwards(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* r, double* x) {
  for (std::int64_t i = first; i < end; ++i) {
    if (i + ahead < end) prefetch(m.A, m.A.starts[i + ahead], m.A.diagonals[i + ahead]);
    Row row(r + 3 * i);
    const std::int64_t diagonal = m.A.diagonals[i];
    std::int64_t k = m.A.starts[i];
    while (m.A.columns[k] < first) ++k;
    for (; k < diagonal; ++k) row.subtract(m.A.values + 9 * k, at(x, m.A.columns[k]));
    row.store_product(m.inverse + 9 * i, x + 3 * i);
  }
}

void residual(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* x, double* out) {
  const double zero[3] = {0.0, 0.0, 0.0};
  for (std::int64_t i = first; i < end; ++i) {
    if (i + ahead < end) prefetch(m.A, m.A.diagonals[i + ahead] + 1, m.A.starts[i + ahead + 1]);
    Row row(zero, m.added + 3 * i, x + 3 * i);
    for (std::int64_t k = m.A.starts[i]; m.A.columns[k] < first; ++k) {
      row.subtract(m.A.values + 9 * k, at(x, m.A.columns[k]));
    }
    const std::int64_t row_end = m.A.starts[i + 1];
    for (std::int64_t k = m.A.diagonals[i] + 1; k < row_end; ++k) {
      row.subtract(m.A.values + 9 * k, at(x, m.A.columns[k]));
    }
    row.store(out + 3 * i);
  }
}

// A row's nearest new neighbours come last: they are what it waits for.
void backwards(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* r, const double* old,
               double* x) {
  for (std::int64_t i = end - 1; i >= first; --i) {
    if (i - ahead >= first) prefetch(m.A, m.A.starts[i - ahead], m.A.starts[i - ahead + 1]);
    Row row(r + 3 * i, m.added + 3 * i, old + 3 * i);
    const std::int64_t diagonal = m.A.diagonals[i];
    for (std::int64_t k = m.A.starts[i]; k < diagonal; ++k) row.subtract(m.A.values + 9 * k, at(old, m.A.columns[k]));
    std::int64_t k = m.A.starts[i + 1] - 1;
    for (; m.A.columns[k] >= end; --k) row.subtract(m.A.values + 9 * k, at(old, m.A.columns[k]));
    for (; k > diagonal; --k) row.subtract(m.A.values + 9 * k, at(x, m.A.columns[k]));
    row.store_product(m.inverse + 9 * i, x + 3 * i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flexcast {

HWY_EXPORT(forwards);
HWY_EXPORT(residual);
HWY_EXPORT(backwards);

void sweep_forwards(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* r, double* x) {
  HWY_DYNAMIC_DISPATCH(forwards)(m, first, end, r, x);
}

void calc_forward_residual(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* x,
                           double* residual_out) {
  HWY_DYNAMIC_DISPATCH(residual)(m, first, end, x, residual_out);
}

void sweep_backwards(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* r, const double* old,
                     double* x) {
  HWY_DYNAMIC_DISPATCH(backwards)(m, first, end, r, old, x);
}

}  // namespace flexcast
#endif
