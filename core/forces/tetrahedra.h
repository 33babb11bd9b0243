// The linear (four-node) tetrahedra of a body: F = [x1-x0, x2-x0, x3-x0] [X1-X0, X2-X0, X3-X0]^-1, P from the body's
// law, f_a = -V P grad N_a with the rest volume V. Kelvin-Voigt damping: the stress F (lambda tr(E') I + 2 mu E') beta
// with E' = sym(F^T F'), the rate of the Green strain; laws of small strain take sym F' instead.
// Source: T. Belytschko, W. K. Liu, B. Moran, Nonlinear Finite Elements for Continua and Structures, chapter 4.
#pragma once

#include <memory>

#include "core/forces/force.h"

namespace flexcast {
void make_tetrahedra(const Model& model, std::vector<std::unique_ptr<Force>>& forces);
}
