// The classical Runge-Kutta scheme of fourth order: four evaluations of the forces a step.
// Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, Springer 1993, section II.1.
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow rk4_row;
}
