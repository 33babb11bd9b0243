#include "core/solvers/gauss_seidel.h"

#include <algorithm>
#include <atomic>

#include "core/base/parallel.h"
#include "core/solvers/gauss_seidel_kernels.h"

namespace flexcast {
namespace {

constexpr std::int32_t rows_per_chunk = 2048;

// The inverse of D over the degrees of freedom that have a stiffness of their own; false: a pivot is negative.
bool invert(const Mat3& D, double* inverse) {
  // D = L diag(d) L^T, a pivot that rounding has left of its entry counts as none.
  Mat3 L = Mat3::Identity();
  Vec3 d = Vec3::Zero();
  bool positive = true;
  for (int k = 0; k < 3; ++k) {
    double pivot = D(k, k);
    for (int m = 0; m < k; ++m) pivot -= L(k, m) * L(k, m) * d[m];
    const bool vanishes = std::abs(pivot) <= 1e-12 * std::abs(D(k, k));
    positive = positive && (vanishes || pivot > 0.0);
    d[k] = vanishes ? 0.0 : pivot;
    for (int r = k + 1; r < 3; ++r) {
      double value = D(r, k);
      for (int m = 0; m < k; ++m) value -= L(r, m) * L(k, m) * d[m];
      L(r, k) = d[k] == 0.0 ? 0.0 : value / d[k];
    }
  }
  for (int c = 0; c < 3; ++c) {
    Vec3 y = Vec3::Unit(c);
    for (int r = 0; r < 3; ++r) {
      for (int m = 0; m < r; ++m) y[r] -= L(r, m) * y[m];
    }
    for (int r = 0; r < 3; ++r) y[r] = d[r] == 0.0 ? 0.0 : y[r] / d[r];
    for (int r = 2; r >= 0; --r) {
      for (int m = r + 1; m < 3; ++m) y[r] -= L(m, r) * y[m];
      if (d[r] == 0.0) y[r] = 0.0;
    }
    for (int r = 0; r < 3; ++r) inverse[3 * c + r] = y[r];
  }
  return positive;
}

template <class Call>
void for_chunks(std::int32_t rows, const Call& call) {
  parallel_for((rows + rows_per_chunk - 1) / rows_per_chunk, 1, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t k = first; k < end; ++k) {
      call(k * rows_per_chunk, std::min<std::int64_t>(rows, (k + 1) * rows_per_chunk));
    }
  });
}

}  // namespace

bool GaussSeidel::setup(const BlockMatrix& A) {
  inverse_.resize(9 * static_cast<std::size_t>(A.rows()) + 3, 0.0);
  added_.resize(3 * static_cast<std::size_t>(A.rows()));
  std::atomic<bool> all_positive = true;
  for_chunks(A.rows(), [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t i = first; i < end; ++i) {
      const auto row = static_cast<std::int32_t>(i);
      if (i + 16 < end) __builtin_prefetch(A.diagonal(row + 16).data());
      const auto columns = A.columns(row);
      Vec3 added = Vec3::Zero();
      if (columns.front() < first || columns.back() >= end) {
        const auto blocks = A.blocks(row);
        for (std::size_t k = 0; k < columns.size(); ++k) {
          if (columns[k] < first || columns[k] >= end) added += 0.5 * blocks[k].cwiseAbs().rowwise().sum();
        }
      }
      Mat3 D = A.diagonal(row);
      D.diagonal() += added;
      if (!invert(D, inverse_.data() + 9 * i)) all_positive = false;
      for (int k = 0; k < 3; ++k) added_[3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(k)] = added[k];
    }
  });
  return all_positive;
}

void GaussSeidel::smooth_forwards(const BlockMatrix& A, const VecX& r, VecX& x, VecX& residual) const {
  x.resize(r.size());
  residual.resize(r.size());
  const SweepMatrix sweep{A.block_rows(), inverse_.data(), added_.data()};
  for_chunks(A.rows(),
             [&](std::int64_t first, std::int64_t end) { sweep_forwards(sweep, first, end, r.data(), x.data()); });
  for_chunks(A.rows(), [&](std::int64_t first, std::int64_t end) {
    calc_forward_residual(sweep, first, end, x.data(), residual.data());
  });
}

void GaussSeidel::smooth_backwards(const BlockMatrix& A, const VecX& r, const VecX& old, VecX& x) const {
  x.resize(r.size());
  const SweepMatrix sweep{A.block_rows(), inverse_.data(), added_.data()};
  for_chunks(A.rows(), [&](std::int64_t first, std::int64_t end) {
    sweep_backwards(sweep, first, end, r.data(), old.data(), x.data());
  });
}

}  // namespace flexcast
