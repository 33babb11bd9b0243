// The largest eigenvalue of an operator that is symmetric in an inner product.
#pragma once

#include <functional>

#include "core/base/math.h"

namespace flexcast {

struct LanczosOperator {
  Eigen::Index size = 0;
  std::function<void(const VecX& q, VecX& dual)> weigh;  // dual = S q; inner products are p.S q. Empty: S = 1
  std::function<void(const VecX& dual, VecX& y)> apply;  // y = A q, of dual = S q
};

// With the residual of its Ritz pair added, since the iteration comes from below: a bound in practice. Stops at a
// relative residual of 1e-3, or after 60 applications.
// Source: B. N. Parlett, The Symmetric Eigenvalue Problem, SIAM 1998, chapter 13.
double calc_largest_eigenvalue(const LanczosOperator& A);

}  // namespace flexcast
