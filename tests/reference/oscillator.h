// The one-dimensional oscillator of cases A03 to A06: a spring along x with r = 0.5 m and k_s = 100 N, one end fixed,
// the other a mass of 0.2 kg that starts at rest.
#pragma once

#include <cmath>
#include <memory>
#include <string_view>

#include "tests/support/scene.h"

namespace flexcast::test {

struct Oscillator {
  std::string_view integrator = "symplectic_euler";
  double step = 1e-3;      // s
  double damping = 0.0;    // k_d, N.s
  double start = 0.05;     // m, elongation at time 0
  bool free_ends = false;  // two free masses instead of a fixed end

  static constexpr double rest_length = 0.5;  // m
  static constexpr double stiffness = 100.0;  // k_s, N
  static constexpr double mass = 0.2;         // kg

  double omega() const { return std::sqrt(stiffness / (rest_length * mass) * (free_ends ? 2.0 : 1.0)); }
  double zeta() const { return damping / rest_length / (2.0 * mass * omega()) * (free_ends ? 2.0 : 1.0); }

  std::unique_ptr<Simulation> make_simulation() const {
    return make(concat("name = \"oscillator\"\n", time_table(integrator, step),
                       "[[body]]\nname = \"spring\"\nmodel = \"mass_spring\"\n"
                       "mesh = { shape = \"rope\", cells = [1], size = [",
                       rest_length, "] }\nsprings = { stiffness = ", stiffness, ", damping = ", damping,
                       " }\nmass = ", mass, "\ndisplacement = [ { select = { nodes = [1] }, value = [", start,
                       ", 0, 0] } ]\n", free_ends ? "" : "pin = [ { select = { nodes = [0] } } ]\n"));
  }
};

inline double elongation(const Simulation& simulation) {
  return position(simulation, 1).x() - position(simulation, 0).x() - Oscillator::rest_length;
}
inline double elongation_rate(const Simulation& simulation) {
  return velocity(simulation, 1).x() - velocity(simulation, 0).x();
}

// At rest with elongation `start` at time 0 (Hairer, Lubich, Wanner, Geometric Numerical Integration, chapter I).
inline double calc_exact_elongation(const Oscillator& o, double time) {
  const double decay = o.zeta() * o.omega();
  const double damped = o.omega() * std::sqrt(1.0 - o.zeta() * o.zeta());
  return o.start * std::exp(-decay * time) * (std::cos(damped * time) + decay / damped * std::sin(damped * time));
}

}  // namespace flexcast::test
