#include "core/solvers/pcg.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/solvers/pcg_kernels.h"

namespace flexcast {
namespace {

constexpr std::int64_t rows_per_sum = 512;

}  // namespace

double PcgSolver::dot(const VecX& a, const VecX& b) {
  return parallel_sum(a.size(), 3 * rows_per_sum, partial_, [&](std::int64_t first, std::int64_t end) {
    return dot_entries(a.data(), b.data(), first, end);
  });
}

double PcgSolver::advance(double alpha, VecX& x, double& rz) {
  const PcgVectors vectors{p_.data(), Ap_.data(), x.data(), r_.data(), z_.data(), preconditioner_->inverse_blocks()};
  const std::int64_t rows = x.size() / 3, count = (rows + rows_per_sum - 1) / rows_per_sum;
  partial_.resize(static_cast<std::size_t>(2 * count));
  parallel_for(count, 1, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t k = first; k < end; ++k) {
      const PcgSums sums = advance_rows(vectors, alpha, k * rows_per_sum, std::min(rows, (k + 1) * rows_per_sum));
      partial_[static_cast<std::size_t>(2 * k)] = sums.rr;
      partial_[static_cast<std::size_t>(2 * k + 1)] = sums.rz;
    }
  });
  double rr = 0.0;
  rz = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    rr += partial_[static_cast<std::size_t>(2 * k)];
    rz += partial_[static_cast<std::size_t>(2 * k + 1)];
  }
  return rr;
}

void PcgSolver::turn(double beta) {
  parallel_for(p_.size(), 3 * rows_per_sum,
               [&](std::int64_t first, std::int64_t end) { turn_direction(z_.data(), beta, p_.data(), first, end); });
}

LinearResult PcgSolver::solve(const BlockMatrix& A, const VecX& b, VecX& x) {
  LinearResult result;
  const double target = tolerance_ * b.norm();
  if (b.isZero(0.0)) {
    x.setZero(b.size());
    return result;
  }
  if (!preconditioner_->setup(A)) {
    result.positive_definite = false;
    return result;
  }
  A.multiply(x, Ap_);
  r_ = b - Ap_;
  if (r_.norm() <= target) return result;
  preconditioner_->apply(r_, z_);
  p_ = z_;
  double rz = r_.dot(z_);
  const auto most = static_cast<int>(std::min<std::int64_t>(20000, 100 + 3 * b.size()));
  const bool fused = preconditioner_->inverse_blocks() != nullptr;
  while (result.iterations < most) {
    ++result.iterations;
    const double curvature = A.multiply_dot(p_, Ap_, partial_);
    if (!(curvature > 0.0 && rz > 0.0)) {
      result.positive_definite = false;
      return result;
    }
    double next = 0.0;
    const double rr = advance(rz / curvature, x, next);
    if (std::sqrt(rr) <= target) return result;
    if (!fused) {
      preconditioner_->apply(r_, z_);
      next = dot(r_, z_);
    }
    turn(next / rz);
    rz = next;
  }
  result.converged = false;
  return result;
}

}  // namespace flexcast
