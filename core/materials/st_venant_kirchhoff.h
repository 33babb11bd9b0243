// St. Venant-Kirchhoff elasticity: Hooke's law for the Green strain e = (F^T F - I) / 2, Psi = mu e:e + lambda/2
// tr(e)^2, P = F (2 mu e + lambda tr(e) I). For large turns and small strains: it softens under compression, is weakest
// against it at the stretch 1/sqrt(3), and a mirrored body (F^T F = I, J = -1) is at rest. Source: T. Belytschko, W. K.
// Liu, B. Moran, Nonlinear Finite Elements for Continua and Structures, section 5.4.
#pragma once

#include "core/materials/law.h"

namespace flexcast {
extern const Law st_venant_kirchhoff_law;
}
