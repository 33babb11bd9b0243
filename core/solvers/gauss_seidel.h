// Symmetric block Gauss-Seidel as multigrid's smoother: forwards from zero before the coarse grid, backwards after it.
// Rows are cut into chunks of fixed size; between chunks the iteration is Jacobi's, made to converge for any symmetric
// positive definite matrix by adding half the row sum of absolute values of the couplings between chunks to the
// diagonal. So chunks can run at the same time, and the result does not depend on how many do.
// Source: A. Baker, R. Falgout, T. Kolev, U. Yang, Multigrid smoothers for ultraparallel computing, SIAM J. Sci.
// Comput. 33(5), 2011, 2864-2887.
#pragma once

#include <vector>

#include "core/base/block_matrix.h"

namespace flexcast {

class GaussSeidel {
 public:
  // False: a diagonal block is not positive definite. Degrees of freedom whose diagonal (nearly) vanishes stay zero.
  bool setup(const BlockMatrix& A);
  // Solves M x = r and gives residual = r - A x, M the lower triangle.
  void smooth_forwards(const BlockMatrix& A, const VecX& r, VecX& x, VecX& residual) const;
  // x = old + M^-T (r - A old).
  void smooth_backwards(const BlockMatrix& A, const VecX& r, const VecX& old, VecX& x) const;

 private:
  std::vector<double> inverse_;  // 9 a row, and three more
  std::vector<double> added_;    // 3 a row
};

}  // namespace flexcast
