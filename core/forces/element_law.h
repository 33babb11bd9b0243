// A body's law with the values now in force.
#pragma once

#include "core/forces/model.h"
#include "core/forces/tetrahedra_kernels.h"

namespace flexcast {

inline ElementLaw make_element_law(const Body& body) {
  const Lame lame = calc_lame(body.young, body.poisson);
  const double beta = body.stiffness_damping;
  return {body.law, lame, {beta * lame.mu, beta * lame.lambda}, body.law->small_strain};
}

}  // namespace flexcast
