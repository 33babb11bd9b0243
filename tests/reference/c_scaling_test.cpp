// C15: the engine knows no absolute lengths, times or stresses: scaled by powers of two, every bit follows.
#include <gtest/gtest.h>

#include "core/integrators/integrator.h"
#include "tests/reference/tables.h"
#include "tests/support/model.h"
#include "tests/support/random.h"
#include "tests/support/reference.h"

namespace flexcast::test {
namespace {

// How a run's units differ from those of the first; factors are powers of two.
struct Scale {
  double length = 1.0;
  double time = 1.0;
  double mass = 1.0;

  double velocity() const { return length / time; }
  double force() const { return mass * length / (time * time); }
  double pressure() const { return force() / (length * length); }
  double density() const { return mass / (length * length * length); }
};

// Lengths scaled, density and Young's modulus kept (k_s as force, k_d as force times time).
Scale scale_lengths(double s) {
  return {s, s, s * s * s};
}
// Four times the stiffness, half the time.
Scale scale_stiffness() {
  return {1.0, 0.5, 1.0};
}

constexpr double step = 0x1p-10;  // s

Simulation make_lattice_run(std::string_view integrator, const Scale& scale) {
  const Mesh mesh = make_lattice({2, 1, 1}, {1.0, 0.5, 0.5});
  Model model = make_spring_model(mesh.nodes, mesh.springs,
                                  {.stiffness = 70.0 * scale.force(), .damping = 0.3 * scale.force() * scale.time},
                                  0.1 * scale.mass);
  model.rest_positions *= scale.length;
  model.bodies[0].mass_damping = 0.2 / scale.time;
  model.bodies[0].drag = 0.01 * scale.mass / scale.time;
  SplitMix64 random(15);
  const VecX x = flatten(mesh.nodes) + make_random_vector(random, model.rest_positions.size(), 0.1);
  const VecX v = make_random_vector(random, model.rest_positions.size(), 1.0);
  return {model,
          make_settings(std::string(integrator), step * scale.time),
          make_state(x * scale.length, v * scale.velocity()),
          {}};
}

// Quadratic elements are softer, so that the step suits explicit schemes.
Simulation make_beam_run(std::string_view law, std::string_view integrator, const Scale& scale,
                         bool quadratic = false) {
  const Mesh mesh = make_beam({quadratic ? 1 : 3, 1, 1}, {1.0, 0.25, 0.25});
  const Elastic elastic{
      .law = law, .young = (quadratic ? 5e3 : 5e4) * scale.pressure(), .density = 900.0 * scale.density()};
  Model model = quadratic ? make_quadratic_model(mesh, elastic) : make_beam_model(mesh, elastic);
  const VecX rest = model.rest_positions;
  model.rest_positions *= scale.length;
  model.bodies[0].mass_damping = 0.2 / scale.time;
  model.bodies[0].stiffness_damping = 1e-3 * scale.time;
  for (std::size_t i = 0; i < 3; ++i) model.fixed[i] = 1;
  SplitMix64 random(16);
  const VecX x = rest + make_random_vector(random, model.rest_positions.size(), 0.02);
  VecX v = make_random_vector(random, model.rest_positions.size(), 1.0);
  block3(v, 0).setZero();
  return {model,
          make_settings(std::string(integrator), step * scale.time),
          make_state(x * scale.length, v * scale.velocity()),
          {}};
}

bool is_explicit(const ReferenceScheme& scheme) {
  return !find_integrator(scheme.integrator)->implicit;
}

// All schemes that know time, the position-based ones too.
std::vector<ReferenceScheme> timed_schemes() {
  std::vector<ReferenceScheme> schemes = reference_schemes();
  schemes.push_back({"xpbd", "", 0});
  schemes.push_back({"vbd", "", 0});
  return schemes;
}

// Runs both and compares every tenth step.
void expect_similar(Simulation& plain, Simulation& scaled, const Scale& scale, bool bit_exact) {
  for (int i = 1; i <= 200; ++i) {
    run(plain, 1);
    run(scaled, 1);
    if (i % 10 != 0) continue;
    const VecX x = plain.state().positions * scale.length, v = plain.state().velocities * scale.velocity();
    if (bit_exact) {
      ASSERT_EQ(scaled.state().positions, x) << "step " << i;
      ASSERT_EQ(scaled.state().velocities, v) << "step " << i;
    } else {
      ASSERT_LE(calc_max_error(scaled.state().positions, x), 1e-12 * x.cwiseAbs().maxCoeff()) << "step " << i;
      ASSERT_LE(calc_max_error(scaled.state().velocities, v), 1e-12 * v.cwiseAbs().maxCoeff()) << "step " << i;
    }
  }
  EXPECT_GT((plain.state().positions - plain.model().rest_positions).cwiseAbs().maxCoeff(), 1e-3);
}

std::vector<Scale> scales() {
  return {scale_lengths(0x1p-20), scale_lengths(0x1p10), scale_stiffness()};
}

TEST(Reference, C15_SpringsScaleToTheBit) {
  for (const ReferenceScheme& scheme : timed_schemes()) {
    for (const Scale& scale : scales()) {
      SCOPED_TRACE(concat(scheme.integrator, " length ", scale.length, " time ", scale.time));
      Simulation plain = make_lattice_run(scheme.integrator, {}), scaled = make_lattice_run(scheme.integrator, scale);
      expect_similar(plain, scaled, scale, is_explicit(scheme));
    }
  }
}

TEST(Reference, C15_TetrahedraScaleToTheBit) {
  for (const ReferenceLaw& law : reference_laws()) {
    for (const ReferenceScheme& scheme : timed_schemes()) {
      for (const Scale& scale : scales()) {
        SCOPED_TRACE(concat(law.law, " ", scheme.integrator, " length ", scale.length, " time ", scale.time));
        Simulation plain = make_beam_run(law.law, scheme.integrator, {});
        Simulation scaled = make_beam_run(law.law, scheme.integrator, scale);
        expect_similar(plain, scaled, scale, is_explicit(scheme));
      }
    }
  }
}

TEST(Reference, C15_QuadraticTetrahedraScaleToTheBit) {
  for (const std::string_view law : {"corotational", "neo_hookean"}) {
    for (const ReferenceScheme& scheme : timed_schemes()) {
      for (const Scale& scale : scales()) {
        SCOPED_TRACE(concat(law, " ", scheme.integrator, " length ", scale.length, " time ", scale.time));
        Simulation plain = make_beam_run(law, scheme.integrator, {}, true);
        Simulation scaled = make_beam_run(law, scheme.integrator, scale, true);
        expect_similar(plain, scaled, scale, is_explicit(scheme));
      }
    }
  }
}

// The largest mode is found by iteration, to a relative tolerance.
TEST(Reference, C15_AdvertisedStepScalesWithTime) {
  for (const Scale& scale : scales()) {
    for (const char* integrator : {"symplectic_euler", "rk4"}) {
      const double lattice = scale.time * make_lattice_run(integrator, {}).calc_stable_step();
      EXPECT_NEAR(make_lattice_run(integrator, scale).calc_stable_step(), lattice, 1e-12 * lattice);
      const double beam = scale.time * make_beam_run("corotational", integrator, {}).calc_stable_step();
      EXPECT_NEAR(make_beam_run("corotational", integrator, scale).calc_stable_step(), beam, 1e-12 * beam);
    }
  }
}

}  // namespace
}  // namespace flexcast::test
