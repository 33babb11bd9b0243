// Symplectic Euler: v += h a(x, v), then x += h v with the new v. First order; energies of undamped scenes stay
// bounded. Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, Springer 2006, chapter I.
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow symplectic_euler_row;
}
