// Contact of particles with solid planes, spheres and boxes: a particle at depth d below a surface is pushed out along
// the surface's normal by k d, energy k d^2 / 2. Where the scene gives no stiffness, the engine takes
//   k = m max(omega^2 / 4, 1e4 |g| / L)
// for a particle of mass m in a body whose fastest elastic mode is at most omega, L the diagonal of the scene's box at
// rest: contact is as stiff as an element of the body, which costs explicit schemes a tenth to a quarter of their step,
// and weight alone presses a free particle in by L / 10^4. Where there is neither elasticity nor weight it takes m
// times 10^4 / s^2; where all particles are in one place L is 1 m. Friction: Coulomb's.
#pragma once

#include <memory>

#include "core/forces/force.h"

namespace flexcast {
void make_contact(const Model& model, std::vector<std::unique_ptr<Force>>& forces);
}
