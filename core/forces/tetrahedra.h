// The tetrahedra of a body, linear or quadratic: F = sum_a x_a grad N_a^T at the quadrature points (at the one of a
// linear element that is [x1-x0, x2-x0, x3-x0] [X1-X0, X2-X0, X3-X0]^-1), P from the body's law,
// f_a = -sum_q w_q P_q grad N_a with w_q the rest volume of a point; Kelvin-Voigt damping as in kelvin_voigt.h.
// Source: T. Belytschko, W. K. Liu, B. Moran, Nonlinear Finite Elements for Continua and Structures, chapter 4.
#pragma once

#include <memory>

#include "core/forces/force.h"

namespace flexcast {
void make_tetrahedra(const Model& model, std::vector<std::unique_ptr<Force>>& forces);
}
