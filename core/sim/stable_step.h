// The largest stable step of an explicit scheme for a scene, linearised at a state.
#pragma once

#include "core/forces/system.h"
#include "core/integrators/integrator.h"

namespace flexcast {

// s: the smallest limit that the scheme has for a mode that a body can have; infinite where nothing moves, 0 where no
// step is stable. At rest the damping inside a body is its stiffness times a constant, and drag damps every particle by
// a known rate: where these are equal all modes lie on a line. Else what modes can be is cut where the scheme's limit
// is smallest (cutting planes: J. E. Kelley, J. Soc. Indust. Appl. Math. 8 (1960) 703-712), and the scheme looks at the
// coupled modes itself. Away from rest it is a bound from the fastest and the most damped mode.
double calc_stable_step(const System& system, const Model& model, const VecX& x, const IntegratorRow& row);

}  // namespace flexcast
