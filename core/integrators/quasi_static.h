// Equilibrium at every step, without inertia and damping: Newton's method on the potential U(x), its Hessians shifted
// by r M with r as small as the line search allows, so that mechanisms and rigid modes are no trouble. Velocities are
// zero. Bodies that nothing holds do not drift: dead loads on them are balanced by a rigid acceleration (inertia
// relief), and their mean rotation and translation over a step is undone. A step takes at most solver.newton_iterations
// and says when that was too few; the next one goes on from there. Friction does not act. Source: J. Nocedal, S. J.
// Wright, Numerical Optimization, Springer 2006, sections 3.4 and 10.3.
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow quasi_static_row;
}
