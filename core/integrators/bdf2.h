// The two-step backward differentiation formula for steps of any lengths, w = h_n / h_{n-1}:
//   y_{n+1} = y* + g y'_{n+1},  y* = [(1 + w)^2 y_n - w^2 y_{n-1}] / (1 + 2 w),  g = h_n (1 + w) / (1 + 2 w),
// for positions and velocities alike: a backward Euler step of length g from (x*, v*). Where there is no last step (at
// the start, after a jump) it is backward Euler. Damping takes its directions at x_n + h v_n.
// Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, Springer 1993, section III.5.
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow bdf2_row;
}
