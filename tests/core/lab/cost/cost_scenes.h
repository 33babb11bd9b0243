// Scenes that name every feature, none, and all of them put to nothing.
#pragma once

#include <string>
#include <vector>

namespace flexcast::test {

// Has everything that can be left out.
inline constexpr const char* everything = R"(
name = "everything"
gravity = [0, 0, -9.81]
[time]
step = 1e-4
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [2, 1, 1], size = [0.4, 0.2, 0.2] }
material = { law = "corotational", young = 1e4, poisson = 0.3, density = 1000.0 }
damping = { mass = 0.5, stiffness = 0.001 }
surface_force = [ { select = { box = [[0.39, -1, -1], [1, 1, 1]] }, value = [1.0, 0.0, 0.0] } ]
handle = [ { name = "grip", select = { box = [[-1e-9, -1, -1], [1e-9, 1, 1]] }, translate = [0.01, 0, 0], duration = 1.0 } ]
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [4], size = [1.0] }
springs = { stiffness = 10.0, damping = 0.001 }
mass = 0.01
drag = 0.01
force = [ { select = { nodes = [4] }, value = [0.1, 0.0, 0.0] } ]
[[contact]]
name = "ground"
shape = "plane"
point = [0, 0, -0.01]
normal = [0, 0, 1]
friction = 0.4
[[probe]]
name = "end"
body = "rope"
node = 4
[stream]
fields = ["positions", "stretch"]
)";

// Has nothing of it.
inline std::string bare(const std::string& integrator) {
  return "name = \"bare\"\n[time]\nstep = 1e-3\nintegrator = \"" + integrator + "\"\n" + R"([[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [2, 1, 1], size = [0.4, 0.2, 0.2] }
material = { law = "corotational", young = 1e4, poisson = 0.3, density = 1000.0 }
displacement = [ { select = { nodes = [2, 5] }, value = [0.01, 0.0, 0.01] } ]
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [4], size = [1.0] }
springs = { stiffness = 10.0 }
mass = 0.01
origin = [0.0, 1.0, 0.0]
displacement = [ { select = { nodes = [4] }, value = [0.1, 0.1, 0.0] } ]
)";
}

// The same with everything named and put to nothing.
inline std::vector<std::string> nothing() {
  return {"gravity=[0, 0, 0]",
          "beam.damping={ mass = 0, stiffness = 0 }",
          "beam.drag=0",
          "rope.springs={ stiffness = 10.0, damping = 0 }",
          "rope.damping={ mass = 0 }",
          "contact=[]",
          "beam.handle=[]",
          "rope.force=[]",
          "beam.surface_force=[]"};
}

}  // namespace flexcast::test
