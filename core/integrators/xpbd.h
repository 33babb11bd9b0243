// Extended position-based dynamics: backward Euler solved by Gauss-Seidel over compliant constraints, one a spring,
// tetrahedron, contact or grab, solver.iterations sweeps a step. Few sweeps and many substeps are its place: what the
// sweeps do not reach acts softer. Constraints change direction while it sweeps, so that even converged it differs from
// backward Euler by the order (h omega)^2. Tetrahedra damp along their constraint, friction acts on positions.
// Sources: M. Macklin, M. Mueller, N. Chentanez, XPBD, Motion in Games 2016; M. Macklin et al., Small Steps in Physics
// Simulation, SCA 2019.
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow xpbd_row;
}
