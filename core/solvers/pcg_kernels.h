// What conjugate gradients do between two products with the matrix, in few passes over the vectors.
#pragma once

#include <cstdint>

namespace flexcast {

struct PcgVectors {
  const double* p = nullptr;
  const double* Ap = nullptr;
  double* x = nullptr;
  double* r = nullptr;
  double* z = nullptr;
  const double* inverse_blocks = nullptr;  // of block-Jacobi, 9 a block and three more; null: z is not made here
};

struct PcgSums {
  double rr = 0.0, rz = 0.0;
};

// x += alpha p, r -= alpha Ap, z = M^-1 r for the block rows [first, end); the sums r.r and r.z over them.
PcgSums advance_rows(const PcgVectors& vectors, double alpha, std::int64_t first, std::int64_t end);
// p = z + beta p for entries [first, end).
void turn_direction(const double* z, double beta, double* p, std::int64_t first, std::int64_t end);
// The sum of a_i b_i over entries [first, end).
double dot_entries(const double* a, const double* b, std::int64_t first, std::int64_t end);

}  // namespace flexcast
