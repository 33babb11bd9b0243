// Linear elasticity: small strain e = sym(F) - I, Psi = mu e:e + lambda/2 tr(e)^2, P = 2 mu e + lambda tr(e) I.
// It does not know rotations: a turned body feels a force and a torque. For small displacements only.
#pragma once

#include "core/materials/law.h"

namespace flexcast {
extern const Law linear_law;
}
