// M = the 3 x 3 diagonal blocks of A.
#pragma once

#include <vector>

#include "core/solvers/preconditioner.h"

namespace flexcast {

class BlockJacobi final : public Preconditioner {
 public:
  bool setup(const BlockMatrix& A) override;
  void apply(const VecX& r, VecX& z) override;
  const double* inverse_blocks() const override { return inverse_.data()->data(); }

 private:
  std::vector<Mat3> inverse_;  // and one more, so that kernels may read behind the last
};

}  // namespace flexcast
