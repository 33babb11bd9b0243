// The product of some rows of a BlockMatrix with a vector, in the widest instructions the processor has.
#pragma once

#include "core/base/block_matrix.h"

namespace flexcast {

// y_i = sum_j A_ij x_j for first <= i < end. Returns the sum of x_i.y_i over them.
double multiply_block_rows(const BlockRows& A, std::int64_t first, std::int64_t end, const double* x, double* y);

}  // namespace flexcast
