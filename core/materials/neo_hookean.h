// Stable neo-Hookean elasticity, with the logarithm that keeps flat and collapsed elements from being at rest:
//   Psi = m/2 (Ic - 3) + l/2 (J - a)^2 - m/2 ln(Ic + 1) minus its value at rest,  Ic = tr(F^T F), J = det F,
//   P = m (1 - 1/(Ic + 1)) F + l (J - a) cof F.
// m = 4 mu/3, l = lambda + 5 mu/6 and a = 1 + m/l - m/(4 l) make it Hooke's law with mu and lambda at small strains.
// It is defined for every F and pushes inverted elements back. l > 0 for every Poisson's ratio nu from -1 to 0.5, but
// rest is the only minimum of Psi from nu = -0.85 on: F = s I is pushed back for all 0 < s < 1 if and only if
// l/mu > (3 s - 1) / ((3 s^2 + 1) (1 + s + s^2)) there, which fails at s = 0.69 for nu < -0.8510.
// Source: B. Smith, F. de Goes, T. Kim, Stable neo-Hookean flesh simulation, ACM TOG 37(2), 2018.
#pragma once

#include "core/materials/law.h"

namespace flexcast {
extern const Law neo_hookean_law;
}
