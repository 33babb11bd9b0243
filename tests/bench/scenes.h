// Scenes that are timed: beams of tetrahedra and cloths of springs, as TOML.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/sim/simulation.h"

namespace flexcast::bench {

// 1 x 0.125 x 0.125 m, poisson 0.4, 1000 kg/m^3, held at x = 0, under gravity.
struct Beam {
  int n = 6;  // size: 3, 6, 13, 28
  std::string law = "corotational";
  std::string element = "tet4";
  double young = 1e6;  // Pa
};

// 1 x 1 m of side x side cells, held at two corners, under gravity.
struct Cloth {
  int side = 100;
};

// How it is stepped. Implicit schemes: linearly implicit, linear_tolerance 1e-6; xpbd and vbd: ten sweeps.
struct Stepping {
  std::string integrator = "symplectic_euler";
  double step = 1e-6;  // s
};

std::string make_scene_text(const Beam& beam, const Stepping& stepping = {});
std::string make_scene_text(const Cloth& cloth, const Stepping& stepping = {});

// Ends the program where the scene does not load.
std::unique_ptr<Simulation> make_simulation(const std::string& scene_text);

struct NamedScene {
  std::string name;
  std::string text;
};

// Of n = 3 and 6 alone when quick.
std::vector<NamedScene> make_kernel_scenes(bool quick);
std::vector<NamedScene> make_step_scenes(bool quick);

}  // namespace flexcast::bench
