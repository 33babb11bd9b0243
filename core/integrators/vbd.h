// Vertex block descent: backward Euler solved by Newton steps of one particle at a time, colour by colour (coloured
// Gauss-Seidel with 3 x 3 blocks, positive semidefinite tangents), solver.iterations sweeps a step. Every update takes
// the incremental potential down to second order, so that it is stable at any step; what the sweeps do not reach acts
// damped.
// Source: A. H. Chen, Z. Liu, Y. Yang, C. Yuksel, Vertex Block Descent, ACM TOG 43(4), 2024.
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow vbd_row;
}
