// Scenes for tests, written as TOML text.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/scene/scene.h"

namespace flexcast::test {

// Everything printed one after the other, numbers with all their digits.
template <class... Parts>
std::string concat(const Parts&... parts) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  (out << ... << parts);
  return out.str();
}

// A scene that does not load fails the test with the reader's message.
inline std::unique_ptr<Simulation> make(const std::string& scene_text) {
  Result<Scene> scene = load_scene_text(scene_text);
  if (!scene) throw std::runtime_error(scene.error().message + "\n" + scene_text);
  return std::move(scene).value().simulation;
}

// Steps that must succeed.
inline void run(Simulation& simulation, std::int64_t steps) {
  for (std::int64_t i = 0; i < steps; ++i) {
    if (!simulation.step()) throw std::runtime_error(simulation.failure()->text());
  }
}

inline Vec3 position(const Simulation& simulation, std::int64_t particle) {
  return block3(simulation.state().positions, particle);
}
inline Vec3 velocity(const Simulation& simulation, std::int64_t particle) {
  return block3(simulation.state().velocities, particle);
}

// Kinetic plus elastic energy, J.
inline double calc_energy(const Simulation& simulation) {
  const StepReport report = simulation.calc_report();
  return report.kinetic + report.elastic;
}

// [solver] of implicit schemes with nothing left to the tolerances; explicit schemes ignore it.
inline std::string tight_solver() {
  return "[solver]\nlinear = \"ldlt\"\nlinear_tolerance = 1e-14\nnewton_tolerance = 1e-14\nnewton_iterations = 50\n";
}

inline std::string time_table(std::string_view integrator, double step) {
  return concat("[time]\nstep = ", step, "\nintegrator = \"", integrator, "\"\n", tight_solver());
}

inline bool engine_has_integrator(std::string_view name) {
  const ParameterRow& row = parameter_row(ParameterRow::Scope::scene, "time.integrator");
  for (const std::string& choice : row.choices) {
    if (choice == name) return true;
  }
  return false;
}

}  // namespace flexcast::test
