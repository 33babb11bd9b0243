// Velocity Verlet, damping from the half-step velocity w:
//   w = v + h/2 a(x, v),   x' = x + h w,   v' = v + h/2 (a(x, w) + a(x', w)).
// Second order also with damping. Without damping a(x, w) = a(x) is the last step's a(x'), so that a step costs one
// evaluation of the forces. Source: as symplectic_euler.h.
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow velocity_verlet_row;
}
