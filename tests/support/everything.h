// A scene with everything that the engine knows at once: springs, linear and
// quadratic tetrahedra, every damping, dead loads, a pin, obstacles of every
// shape with friction, handles that turn and jump.
#pragma once

#include "tests/support/scene.h"

namespace flexcast::test {

inline std::string everything_text(std::string_view integrator, double step = 1e-3) {
  return concat("name = \"everything\"\ngravity = [0.5, 0, -9.81]\n", "[time]\nstep = ", step, "\nintegrator = \"",
                integrator, R"("
[solver]
linear = "ldlt"
newton_tolerance = 1e-9
newton_iterations = 8
iterations = 5
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [3, 1, 1], size = [0.9, 0.3, 0.3] }
material = { law = "corotational", young = 2e4, poisson = 0.3, density = 500.0 }
damping = { mass = 0.1, stiffness = 1e-3 }
origin = [0, 0, 0.01]
particle_mass = [ { select = { nodes = [5] }, value = 3.0 } ]
pin = [ { select = { nodes = [4] }, axes = "y" } ]
force = [ { select = { nodes = [3] }, value = [0, 2.0, 0] } ]
velocity = [ { select = { all = true }, value = [0.5, 0.2, -1.0] } ]
[[body]]
name = "block"
model = "fem"
element = "tet10"
mesh = { shape = "beam", cells = [1, 1, 1], size = [0.3, 0.3, 0.3] }
material = { law = "neo_hookean", young = 3e4, poisson = 0.4, density = 800.0 }
damping = { stiffness = 2e-3 }
origin = [0.1, 0.9, 0.25]
velocity = [ { select = { all = true }, value = [0.3, 0, -0.5], spin = [0, 1, 2] } ]
handle = [ { name = "jump", select = { nodes = [0] }, translate = [0.0, 0.01, 0.02], rotate = [0.0, 0.0, 0.3], start = 0.02 } ]
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [5], size = [1.0] }
springs = { stiffness = 30.0, damping = 0.2 }
mass = 0.05
drag = 0.01
origin = [0, -0.6, 0.3]
velocity = [ { select = { all = true }, value = [0.2, 0, -2], spin = [0, 0, 3] } ]
handle = [ { name = "grip", select = { nodes = [0, 1] }, translate = [0, 0, 0.1], rotate = [0.5, 0.4, 0], start = 0.005, duration = 0.05 } ]
[[contact]]
name = "ground"
shape = "plane"
point = [0, 0, 0.0]
normal = [0, 0.1, 1]
friction = 0.3
[[contact]]
name = "ball"
shape = "sphere"
center = [0.25, 1.05, 0.0]
radius = 0.3
friction = 0.5
[[contact]]
name = "crate"
shape = "box"
lo = [0.6, -0.8, 0.1]
hi = [2, -0.4, 0.29]
)");
}

}  // namespace flexcast::test
