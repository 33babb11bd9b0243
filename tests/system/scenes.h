// Scenes for system tests: small, and lively from the first step on.
#pragma once

#include <string>

namespace flexcast::test {

// A beam of tetrahedra and a rope of springs; every bit of the state goes on the wire. One step a millisecond.
inline std::string pair_scene() {
  return R"(name = "pair"
gravity = [0.0, 0.0, -9.81]

[time]
step = 0.001
integrator = "symplectic_euler"

[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [5, 1, 1], size = [0.5, 0.1, 0.1] }
material = { law = "corotational", young = 1e5, poisson = 0.3, density = 1000.0 }
damping = { stiffness = 0.0001 }
pin = [ { select = { box = [[-1e-9, -1.0, -1.0], [1e-9, 1.0, 1.0]] } } ]
velocity = [ { select = { all = true }, spin = [0.0, 3.0, 5.0] } ]

[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [10], size = [1.0] }
springs = { stiffness = 50.0, damping = 0.01 }
mass = 0.05
origin = [0.0, 0.0, 1.0]
pin = [ { select = { nodes = [0] } } ]

[[probe]]
name = "end"
body = "rope"
node = 10

[stream]
fields = ["positions", "velocities"]
precision = "float64"
)";
}

// A rope let go from the horizontal, with `time_step` and `stiffness` as given.
inline std::string rope_scene(const std::string& name = "rope", const std::string& time_step = "0.001",
                              const std::string& stiffness = "50.0") {
  return "name = \"" + name + R"("
gravity = [0.0, 0.0, -9.81]

[time]
step = )" +
         time_step + R"(
integrator = "symplectic_euler"

[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [10], size = [1.0] }
springs = { stiffness = )" +
         stiffness + R"(, damping = 0.01 }
mass = 0.05
pin = [ { select = { nodes = [0] } } ]

[[probe]]
name = "end"
body = "rope"
node = 10
)";
}

// A sheet of (cells + 1)^2 particles at rest but for one corner: 12 bytes a particle on the wire.
inline std::string sheet_scene(int cells) {
  const std::string number = std::to_string(cells);
  return R"(name = "sheet"
[time]
step = 0.001
integrator = "symplectic_euler"

[[body]]
name = "sheet"
model = "mass_spring"
mesh = { shape = "grid", cells = [)" +
         number + ", " + number + R"(], size = [3.0, 3.0] }
springs = { stiffness = 1.0 }
mass = 0.01
velocity = [ { select = { box = [[0.0, 0.0, -1.0], [1.0, 1.0, 1.0]] }, value = [0.1, 0.2, 1.0] } ]
)";
}

}  // namespace flexcast::test
