// Sweeps of block Gauss-Seidel over one chunk of rows, in the widest instructions the processor has.
#pragma once

#include "core/base/block_matrix.h"

namespace flexcast {

struct SweepMatrix {
  BlockRows A;
  const double* inverse = nullptr;  // of the diagonal blocks with what is added to them; 9 a row, and three more
  const double* added = nullptr;    // 3 a row
};

// x of the lower triangle within the chunk, from zero.
void sweep_forwards(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* r, double* x);
// r - A x after that, from the rest of the matrix alone.
void calc_forward_residual(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* x,
                           double* residual);
// x, from the last row to the first, with `old` where no new value is there yet and in other chunks.
void sweep_backwards(const SweepMatrix& m, std::int64_t first, std::int64_t end, const double* r, const double* old,
                     double* x);

}  // namespace flexcast
