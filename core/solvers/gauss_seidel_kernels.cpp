#include "core/solvers/gauss_seidel_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solvers/gauss_seidel_kernels.cpp"
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
  // Starts with the three doubles at `from`.
  HWY_INLINE explicit Row(const double* from) {
    HWY_ALIGN const double start[4] = {from[0], from[1], from[2], 0.0};
    sum0_ = hn::Load(d_, start);
    sum1_ = sum2_ = hn::Zero(d_);
  }
  HWY_INLINE void subtract(const double* block, const double* x) {
    sum0_ = hn::NegMulAdd(hn::LoadU(d_, block), hn::Set(d_, x[0]), sum0_);
    sum1_ = hn::NegMulAdd(hn::LoadU(d_, block + 3), hn::Set(d_, x[1]), sum1_);
    sum2_ = hn::NegMulAdd(hn::LoadU(d_, block + 6), hn::Set(d_, x[2]), sum2_);
  }
  HWY_INLINE void store(double* to) const { put(hn::Add(hn::Add(sum0_, sum1_), sum2_), to); }
  // to = block times this.
  HWY_INLINE void store_product(const double* block, double* to) const {
    HWY_ALIGN double y[4];
    hn::Store(hn::Add(hn::Add(sum0_, sum1_), sum2_), d_, y);
    const auto first = hn::Mul(hn::LoadU(d_, block), hn::Set(d_, y[0]));
    const auto second = hn::Mul(hn::LoadU(d_, block + 3), hn::Set(d_, y[1]));
    put(hn::MulAdd(hn::LoadU(d_, block + 6), hn::Set(d_, y[2]), hn::Add(first, second)), to);
  }

 private:
  HWY_INLINE void put(hn::Vec<hn::FixedTag<double, 4>> v, double* to) const {
    HWY_ALIGN double y[4];
    hn::Store(v, d_, y);
    to[0] = y[0];
    to[1] = y[1];
    to[2] = y[2];
  }
  hn::FixedTag<double, 4> d_;
  hn::Vec<hn::FixedTag<double, 4>> sum0_, sum1_, sum2_;
};
#else
class Row {
 public:
  explicit Row(const double* from) : sum_{from[0], from[1], from[2]} {}
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

void forwards(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* r, double* x) {
  for (std::int64_t i = first; i < end; ++i) {
    Row row(r + 3 * i);
    const std::int64_t diagonal = m.A.diagonals[i];
    std::int64_t k = m.A.starts[i];
    while (m.A.columns[k] < first) ++k;
    for (; k < diagonal; ++k) row.subtract(m.A.values + 9 * k, at(x, m.A.columns[k]));
    row.store_product(m.inverse + 9 * i, x + 3 * i);
  }
}

void residual(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* x, double* out) {
  for (std::int64_t i = first; i < end; ++i) {
    const double* c = m.added + 3 * i;
    const double start[3] = {c[0] * x[3 * i], c[1] * x[3 * i + 1], c[2] * x[3 * i + 2]};
    Row row(start);
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
    const double* c = m.added + 3 * i;
    const double* mine = old + 3 * i;
    const double start[3] = {r[3 * i] + c[0] * mine[0], r[3 * i + 1] + c[1] * mine[1], r[3 * i + 2] + c[2] * mine[2]};
    Row row(start);
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
