#include "core/solvers/block_jacobi.h"

#include <Eigen/LU>
#include <atomic>

#include "core/base/parallel.h"

namespace flexcast {

bool BlockJacobi::setup(const BlockMatrix& A) {
  inverse_.resize(static_cast<std::size_t>(A.rows()) + 1, Mat3::Zero());
  std::atomic<bool> all_positive = true;
  parallel_for(A.rows(), 1024, [&](std::int64_t first, std::int64_t end) {
    for (auto i = static_cast<std::int32_t>(first); i < end; ++i) {
      const Mat3& D = A.diagonal(i);
      const bool positive = D(0, 0) > 0.0 && D.topLeftCorner<2, 2>().determinant() > 0.0 && D.determinant() > 0.0;
      if (!positive) all_positive = false;
      inverse_[static_cast<std::size_t>(i)] = D.inverse();
    }
  });
  return all_positive;
}

void BlockJacobi::apply(const VecX& r, VecX& z) {
  z.resize(r.size());
  parallel_for(r.size() / 3, 1024, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t i = first; i < end; ++i) block3(z, i) = inverse_[static_cast<std::size_t>(i)] * block3(r, i);
  });
}

}  // namespace flexcast
