// For kernels: single lanes that need the careful way.
#pragma once

namespace flexcast {

struct Law;

// Entries `stride` doubles apart, column by column.
void calc_plain_rotation(const double* F, double* Q, int stride);

// sum_k c_k n_k n_k^T of corotational-inl.h from S, Pa; clamped: with c_k >= -mu.
void calc_plain_twist(double mu, double lambda, bool clamped, const double* S, double* W, int stride);

// The law's own functions.
void calc_plain_stress(const Law& law, double mu, double lambda, const double* F, double* P, int stride);
double calc_plain_energy(const Law& law, double mu, double lambda, const double* F, int stride);

}  // namespace flexcast
