// The loops over the springs of a patch (patches.h), in lanes. Equations: spring.h.
#pragma once

#include <cstdint>

namespace flexcast {

// Batches of eight lanes of one patch.
struct SpringBatches {
  std::int32_t count = 0;
  const std::uint16_t* places = nullptr;         // [batch][end][lane], where p's and q's vectors begin in the patch's
  const double* rest_lengths = nullptr;          // m, [batch][lane]
  const double* inverse_rest_lengths = nullptr;  // 1/m, [batch][lane]; 0: no spring
};

// Patch vectors: four doubles a particle, x, y, z and 0. k_s in N, k_d in N.s.
// Elastic forces on p at x, as rows [batch][lane][4].
void calc_spring_forces(const SpringBatches& springs, double k_s, const double* x, double* rows);
// Elastic and damping forces on p at x, v, as rows; the power that damping takes, W.
double calc_damped_spring_forces(const SpringBatches& springs, double k_s, double k_d, const double* x, const double* v,
                                 double* rows);
// J.
double calc_spring_energy(const SpringBatches& springs, double k_s, const double* x);

// One sweep of position-based dynamics over the springs: see sweep_constraints in springs.cpp. Positions start,
// displacements u from there and inverse masses are patch vectors; lambda is [batch][lane].
struct SpringSweep {
  double h = 0.0;  // s
  double k_s = 0.0, k_d = 0.0;
  const double* start = nullptr;
  const double* inverse_masses = nullptr;
  double* lambda = nullptr;
  double* u = nullptr;
};
void sweep_spring_constraints(const SpringBatches& springs, const SpringSweep& sweep);

}  // namespace flexcast
