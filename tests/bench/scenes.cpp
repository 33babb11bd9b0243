#include "tests/bench/scenes.h"

#include <cstdio>
#include <cstdlib>

#include "core/materials/law.h"
#include "core/scene/scene.h"

namespace flexcast::bench {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string make_head(const Stepping& stepping) {
  return "name = \"bench\"\ngravity = [0.0, 0.0, -9.81]\n[time]\nstep = " + number(stepping.step) +
         "\nintegrator = \"" + stepping.integrator +
         "\"\n[solver]\nnewton_iterations = 1\nlinear_tolerance = 1e-6\niterations = 10\n[[body]]\nname = \"soft\"\n";
}

std::vector<int> beam_sizes(bool quick) {
  return quick ? std::vector<int>{3, 6} : std::vector<int>{3, 6, 13, 28};
}

std::vector<int> cloth_sizes(bool quick) {
  return quick ? std::vector<int>{100} : std::vector<int>{100, 500};
}

std::string title(const Beam& beam) {
  return "beam " + std::to_string(beam.n) + " " + beam.law + " " + beam.element;
}

}  // namespace

std::string make_scene_text(const Beam& beam, const Stepping& stepping) {
  const std::string n = std::to_string(beam.n);
  return make_head(stepping) + "model = \"fem\"\nmesh = { shape = \"beam\", cells = [" + std::to_string(8 * beam.n) +
         ", " + n + ", " + n + "], size = [1.0, 0.125, 0.125] }\nelement = \"" + beam.element +
         "\"\nmaterial = { law = \"" + beam.law + "\", young = " + number(beam.young) +
         ", poisson = 0.4, density = 1000.0 }\npin = [ { select = { box = [[-1e-9, -1, -1], [1e-9, 1, 1]] } } ]\n";
}

std::string make_scene_text(const Cloth& cloth, const Stepping& stepping) {
  const std::string n = std::to_string(cloth.side);
  return make_head(stepping) + "model = \"mass_spring\"\nmesh = { shape = \"grid\", cells = [" + n + ", " + n +
         "], size = [1.0, 1.0] }\nsprings = { stiffness = 10.0 }\ntotal_mass = 0.2\npin = [ { select = { nodes = [0, " +
         n + "] } } ]\n";
}

std::unique_ptr<Simulation> make_simulation(const std::string& scene_text) {
  auto scene = load_scene_text(scene_text);
  if (!scene) {
    std::fprintf(stderr, "%s\n%s", scene.error().message.c_str(), scene_text.c_str());
    std::exit(1);
  }
  return std::move(scene).value().simulation;
}

std::vector<NamedScene> make_kernel_scenes(bool quick) {
  std::vector<NamedScene> scenes;
  const auto add = [&](const Beam& beam) { scenes.push_back({title(beam), make_scene_text(beam)}); };
  for (const int n : beam_sizes(quick)) {
    add({.n = n});
    if (n != 6) continue;
    for (const Law& law : laws()) {
      if (law.name != "corotational") add({.n = n, .law = std::string(law.name)});
    }
    add({.n = n, .element = "tet10"});
    add({.n = n, .law = "neo_hookean", .element = "tet10"});
  }
  for (const int side : cloth_sizes(quick)) {
    scenes.push_back({"cloth " + std::to_string(side), make_scene_text(Cloth{side})});
  }
  return scenes;
}

std::vector<NamedScene> make_step_scenes(bool quick) {
  constexpr double frame = 1.0 / 60.0;  // s
  std::vector<NamedScene> scenes;
  for (const int n : beam_sizes(quick)) {
    const auto add = [&](const Beam& beam, const Stepping& stepping, const std::string& label) {
      scenes.push_back({title(beam) + ": " + label, make_scene_text(beam, stepping)});
    };
    add({.n = n}, {}, "symplectic_euler");
    add({.n = n}, {"backward_euler", frame}, "backward_euler, E = 1e6 Pa");
    add({.n = n, .young = 1e8}, {"backward_euler", frame}, "backward_euler, E = 1e8 Pa");
    add({.n = n}, {"xpbd", frame}, "xpbd, 10 sweeps");
    add({.n = n}, {"vbd", frame}, "vbd, 10 sweeps");
  }
  for (const int side : cloth_sizes(quick)) {
    const std::string name = "cloth " + std::to_string(side) + ": ";
    scenes.push_back({name + "symplectic_euler", make_scene_text(Cloth{side})});
    scenes.push_back({name + "backward_euler", make_scene_text(Cloth{side}, {"backward_euler", frame})});
    scenes.push_back({name + "xpbd, 10 sweeps", make_scene_text(Cloth{side}, {"xpbd", frame})});
    scenes.push_back({name + "vbd, 10 sweeps", make_scene_text(Cloth{side}, {"vbd", frame})});
  }
  return scenes;
}

}  // namespace flexcast::bench
