// The volume a body of tetrahedra has at present.
#pragma once

#include "core/forces/model.h"

namespace flexcast {

// m^3, exact for linear and quadratic tetrahedra; 0 for springs. Inverted parts count negative.
double calc_volume(const Model& model, const Body& body, const VecX& positions);

// One per body.
VecX calc_volumes(const Model& model, const VecX& positions);

}  // namespace flexcast
