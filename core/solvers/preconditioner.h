// z = M^-1 r with M symmetric and positive definite, close to A in some sense.
#pragma once

#include "core/base/block_matrix.h"

namespace flexcast {

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  // To be called when the values of A have changed; A must stay until the last apply. The pattern is the same at every
  // call. False: A is not positive definite.
  virtual bool setup(const BlockMatrix& A) = 0;
  virtual void apply(const VecX& r, VecX& z) = 0;
  // The inverses of the diagonal blocks, 9 doubles each, where M is no more than those blocks: then there are loops
  // that do more than applying it in one pass. Three doubles more may be read.
  virtual const double* inverse_blocks() const { return nullptr; }
};

}  // namespace flexcast
