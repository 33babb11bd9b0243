#include "core/solvers/pcg.h"

#include <Eigen/LU>
#include <algorithm>

namespace flexcast {

bool PcgSolver::invert_diagonal(const BlockMatrix& A) {
  inverse_diagonal_.resize(static_cast<std::size_t>(A.rows()));
  for (std::int32_t i = 0; i < A.rows(); ++i) {
    const Mat3& D = A.diagonal(i);
    const bool positive = D(0, 0) > 0.0 && D.topLeftCorner<2, 2>().determinant() > 0.0 && D.determinant() > 0.0;
    if (!positive) return false;
    inverse_diagonal_[i] = D.inverse();
  }
  return true;
}

void PcgSolver::precondition(const VecX& r, VecX& z) const {
  z.resize(r.size());
  for (std::size_t i = 0; i < inverse_diagonal_.size(); ++i) {
    const auto row = static_cast<std::int64_t>(i);
    block3(z, row) = inverse_diagonal_[i] * block3(r, row);
  }
}

LinearResult PcgSolver::solve(const BlockMatrix& A, const VecX& b, VecX& x) {
  LinearResult result;
  const double target = tolerance_ * b.norm();
  if (b.isZero(0.0)) {
    x.setZero(b.size());
    return result;
  }
  if (!invert_diagonal(A)) {
    result.positive_definite = false;
    return result;
  }
  A.multiply(x, Ap_);
  r_ = b - Ap_;
  if (r_.norm() <= target) return result;
  precondition(r_, z_);
  p_ = z_;
  double rz = r_.dot(z_);
  const auto most = static_cast<int>(std::min<std::int64_t>(20000, 100 + 3 * b.size()));
  while (result.iterations < most) {
    ++result.iterations;
    A.multiply(p_, Ap_);
    const double curvature = p_.dot(Ap_);
    if (!(curvature > 0.0)) {
      result.positive_definite = false;
      return result;
    }
    const double alpha = rz / curvature;
    x += alpha * p_;
    r_ -= alpha * Ap_;
    if (r_.norm() <= target) return result;
    precondition(r_, z_);
    const double next = r_.dot(z_);
    p_ = z_ + (next / rz) * p_;
    rz = next;
  }
  result.converged = false;
  return result;
}

}  // namespace flexcast
