// Scenes whose motion is smooth, and how far a run of one is from the truth.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/scene.h"

namespace flexcast::test {

struct SmoothScene {
  std::string name;
  double frame = 0.0;     // s, the step of the scene
  double duration = 0.0;  // s
  std::string body;       // [[body]] and what belongs to it
  std::string gravity = "[0, 0, 0]";

  // `time`: more lines of [time].
  std::string text(std::string_view integrator, const std::string& time) const {
    return concat("name = \"", name, "\"\ngravity = ", gravity, "\n[time]\nstep = ", frame, "\nintegrator = \"",
                  integrator, "\"\n", time, "\n[solver]\nlinear = \"ldlt\"\nnewton_tolerance = 1e-11\n", body);
  }
  std::int64_t frames() const { return std::llround(duration / frame); }
};

inline void PrintTo(const SmoothScene& scene, std::ostream* out) {
  *out << scene.name;
}

// A swinging beam, a rope that swings as a whole, a sheet plucked in its plane, a spinning and breathing block, a
// damped beam that a handle bends gently.
inline std::vector<SmoothScene> smooth_scenes() {
  const std::string beam =
      "[[body]]\nname = \"beam\"\nmodel = \"fem\"\n"
      "mesh = { shape = \"beam\", cells = [6, 1, 1], size = [1.0, 0.2, 0.2] }\n"
      "material = { law = \"corotational\", young = 2e5, poisson = 0.3, density = 1000.0 }\n"
      "pin = [ { select = { box = [[-1e-9, -1, -1], [1e-9, 1, 1]] } } ]\n";
  return {
      {"swing", 0.02, 0.6, beam, "[0, 0, -9.81]"},
      {"pendulum", 0.02, 1.0,
       "[[body]]\nname = \"rope\"\nmodel = \"mass_spring\"\nmesh = { shape = \"rope\", cells = [3], size = [1.0] }\n"
       "springs = { stiffness = 60.0, damping = 0.02 }\nmass = 0.1\npin = [ { select = { nodes = [0] } } ]\n"
       "velocity = [ { select = { nodes = [3] }, value = [0, 0.6, 0] }, { select = { nodes = [2] }, value = [0, 0.4, "
       "0] "
       "}, { select = { nodes = [1] }, value = [0, 0.2, 0] } ]\n",
       "[9.81, 0, 0]"},
      {"sheet", 0.02, 1.0,
       "[[body]]\nname = \"sheet\"\nmodel = \"mass_spring\"\nmesh = { shape = \"grid\", cells = [4, 4], size = [1, 1] "
       "}\n"
       "springs = { stiffness = 4.0, damping = 0.004 }\nmass = 0.02\npin = [ { select = { box = [[-1, -1e-9, -1], [2, "
       "1e-9, 1]] } } ]\nvelocity = [ { select = { box = [[-1, 0.9, -1], [2, 2, 1]] }, value = [0.5, 0.3, 0] } ]\n"},
      {"block", 0.02, 0.8,
       "[[body]]\nname = \"block\"\nmodel = \"fem\"\nmesh = { shape = \"beam\", cells = [2, 2, 2], size = [0.5, 0.5, "
       "0.5] }\nmaterial = { law = \"neo_hookean\", young = 2e4, poisson = 0.3, density = 500.0 }\n"
       "velocity = [ { select = { all = true }, spin = [0, 1.0, 3.0], about = [0.25, 0.25, 0.25] } ]\n"},
      {"jelly", 0.02, 0.8,
       "[[body]]\nname = \"jelly\"\nmodel = \"mass_spring\"\nmesh = { shape = \"lattice\", cells = [2, 2, 2], size = "
       "[0.4, 0.4, 0.4] }\nsprings = { stiffness = 8.0, damping = 0.01 }\nmass = 0.02\npin = [ { select = { box = "
       "[[-1, "
       "-1, -1e-9], [1, 1, 1e-9]] } } ]\n",
       "[3, 0, -9.81]"},
      {"chain", 0.01, 0.6,
       "[[body]]\nname = \"chain\"\nmodel = \"mass_spring\"\nmesh = { shape = \"rope\", cells = [12], size = [1.0] }\n"
       "springs = { stiffness = 3.0, damping = 0.0 }\nmass = 0.02\npin = [ { select = { nodes = [0, 12] } } ]\n"
       "displacement = [ { select = { nodes = [4, 6] }, value = [0.01, 0, 0] }, { select = { nodes = [5] }, value = "
       "[0.02, "
       "0, 0] } ]\n"},
      {"grip", 0.02, 0.8,
       beam +
           "damping = { stiffness = 0.01 }\nhandle = [ { name = \"grip\", select = { box = [[0.999, -1, -1], [1.1, 1, "
           "1]] }, translate = [0, 0, 0.2], duration = 1.0 } ]\n"},
  };
}

inline double calc_size(const Simulation& simulation) {
  const VecX& rest = simulation.model().rest_positions;
  const Eigen::Map<const Eigen::Matrix3Xd> points(rest.data(), 3, rest.size() / 3);
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

inline double calc_rms_distance(const VecX& a, const VecX& b) {
  return std::sqrt(3.0 * (a - b).squaredNorm() / static_cast<double>(a.size()));
}

// The positions at every frame, to about 1e-9 of the size: fourth order, steps far below the stable one.
inline std::vector<VecX> calc_truth(const SmoothScene& scene) {
  const auto simulation = make(scene.text("rk4", "substeps = 200"));
  std::vector<VecX> truth = {simulation->state().positions};
  for (std::int64_t i = 0; i < scene.frames(); ++i) {
    run(*simulation, 1);
    truth.push_back(simulation->state().positions);
  }
  return truth;
}

}  // namespace flexcast::test
