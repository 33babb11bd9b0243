// The implicit midpoint rule, M (v1 - v0) = h f((x0 + x1)/2, (v0 + v1)/2), x1 - x0 = h (v0 + v1)/2: second order, no
// loss of energy in linear systems, angular momentum kept; what it does not resolve rings on. It is a backward Euler
// step over h/2 and the same change once more. Damping takes its directions at x0 + h v0 / 2.
// Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, Springer 2006, section VI.4.
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow implicit_midpoint_row;
}
