// L diag(d) L^T of a small dense matrix that may be semidefinite: unknowns whose pivot is left over from rounding stay
// 0.
#pragma once

namespace flexcast {

// A: n columns of n, its lower triangle is read; it becomes L below and 1 / d (0: no pivot) on the diagonal. scratch:
// n.
void factor_dense(double* A, int n, double* scratch);
// x: the right-hand side on entry, the solution on return.
void solve_dense(const double* factor, int n, double* x);

}  // namespace flexcast
