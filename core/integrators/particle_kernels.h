// The loops of the passes over the particles, over plain arrays of 3 n numbers. Each returns the work of its range in
// J: eight sums over every eighth number, added in a fixed order, so that it is the same for every instruction set; not
// a number where one that was written is larger than largest_magnitude or none.
#pragma once

#include <cstdint>

namespace flexcast {

// v1 = v0 + kick w F, work kick/2 F . (v0 + v1). With x1, x1 = x0 + drift v, v the velocities before or after.
struct KickArrays {
  const double* inverse_masses;  // w, 1/kg
  const double* F;               // N
  const double* v0;              // m/s
  double* v1;                    // may be v0
  double kick;                   // s
  const double* x0 = nullptr;    // m
  double* x1 = nullptr;          // may be x0; none: no drift
  double drift = 0.0;            // s
  bool by_old_velocities = false;
};
double run_kick(const KickArrays& arrays, std::int64_t first, std::int64_t end);

// x1 = x0 + drift v; no work.
struct DriftArrays {
  const double* v;   // m/s
  const double* x0;  // m
  double* x1;        // may be x0
  double drift;      // s
};
double run_drift(const DriftArrays& arrays, std::int64_t first, std::int64_t end);

// x1 = base + reach u; v1 = u / time - past v0 where free, v0 elsewhere; work (v1 - v0) . m (v0 + v1) / 2.
struct FollowArrays {
  const double* masses;  // m, kg
  const double* free;    // 1, or 0 where held
  const double* base;    // m
  const double* u;       // m
  const double* v0;      // m/s
  double* x1;            // may be base
  double* v1;            // may be v0
  double reach, time, past;
};
double run_follow(const FollowArrays& arrays, std::int64_t first, std::int64_t end);

}  // namespace flexcast
