// Backward (implicit) Euler: x' = x + h v', v' = v + h a(x', v'). With u = x' - x the step minimises the incremental
// potential
//   |u - h v|_M^2 / (2 h^2) + V(x + u) + u^T D(x) u / (2 h),
// V the energy of all conservative forces. Damping is linear in the new velocity, with the directions and shapes at
// the start of the step. Newton starts from u = 0, so that one iteration is the linearly implicit scheme.
// Source: C. Kane, J. E. Marsden, M. Ortiz, M. West, Variational integrators..., IJNME 49 (2000).
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow backward_euler_row;
}
