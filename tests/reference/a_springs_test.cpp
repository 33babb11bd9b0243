// A02, C11: the spring law, and where it has no direction.
#include <gtest/gtest.h>

#include "core/forces/spring.h"
#include "tests/reference/tables.h"
#include "tests/support/model.h"
#include "tests/support/reference.h"

namespace flexcast::test {
namespace {

constexpr double k_s = 120.0;  // N
constexpr double k_d = 0.75;   // N.s
constexpr double r = 0.4;      // m

const Json& golden_springs() {
  static const Json springs = load_reference("springs.json");
  return springs["golden ks=120 N, kd=0.75 N.s, r=0.4 m"];
}

TEST(Reference, A02_SpringForceAndEnergyMatchTheGoldenVectors) {
  for (const Json& row : golden_springs()) {
    SCOPED_TRACE(row["xj"].dump());
    const Vec3 d = to_vector(row["xj"]) - to_vector(row["xi"]);
    const Vec3 v = to_vector(row["vj"]) - to_vector(row["vi"]);
    const Vec3 expected = to_vector(row["f_i"]);
    EXPECT_LE(calc_max_error(calc_spring_force(d, v, r, k_s, k_d), expected), 1e-12 * expected.cwiseAbs().maxCoeff());
    const double energy = row["energy"], power = row["power_dissipated"];
    EXPECT_NEAR(calc_spring_energy(d, r, k_s), energy, 1e-12 * energy);
    EXPECT_NEAR(-calc_spring_damping_force(d, v, r, k_d).dot(v), -power, 1e-12 * power);
  }
}

TEST(Reference, A02_SpringForceInASceneMatchesTheGoldenVectors) {
  const Model model = make_spring_model({{0, 0, 0}, {r, 0, 0}}, {{0, 1}}, {.stiffness = k_s, .damping = k_d}, 0.25);
  for (const Json& row : golden_springs()) {
    SCOPED_TRACE(row["xj"].dump());
    const VecX x = flatten({to_vector(row["xi"]), to_vector(row["xj"])});
    const VecX v = flatten({to_vector(row["vi"]), to_vector(row["vj"])});
    const VecX f = measure_forces(model, x, v);
    const Vec3 expected = to_vector(row["f_i"]);
    const double scale = expected.cwiseAbs().maxCoeff();
    EXPECT_LE(calc_max_error(block3(f, 0), expected), 1e-12 * scale);
    EXPECT_LE(calc_max_error(block3(f, 1), -expected), 1e-12 * scale);
    EXPECT_NEAR(measure_elastic_energy(model, x), row["energy"], 1e-12 * row["energy"].get<double>());
  }
}

std::string rope_of_size(const std::string& size, const std::string& more = "") {
  return "name = \"rope\"\n" + time_table("symplectic_euler", 1e-3) +
         "[[body]]\nname = \"rope\"\nmodel = \"mass_spring\"\nmesh = { shape = \"rope\", cells = [1], size = [" + size +
         "] }\nsprings = { stiffness = 120, damping = 0.75 }\nmass = 0.25\n" + more;
}

TEST(Reference, C11_SpringsWithoutAPositiveRestLengthAreRejectedByName) {
  for (const char* size : {"0", "0.0", "-1", "nan", "inf", "-inf"}) {
    const Result<Scene> scene = load_scene_text(rope_of_size(size));
    ASSERT_FALSE(scene.ok()) << size;
    EXPECT_NE(scene.error().message.find("size"), std::string::npos) << scene.error().message;
  }
  // A rest length below the smallest double: the coordinate of the second node is lost.
  EXPECT_FALSE(load_scene_text(rope_of_size("1.0", "origin = [1e300, 0, 0]\n")).ok());
}

TEST(Reference, C11_CoincidentEndsFeelNoForceUnderAnyScheme) {
  EXPECT_EQ(calc_spring_force(Vec3::Zero(), Vec3(1, 2, 3), r, k_s, k_d), Vec3::Zero());
  for (const ReferenceScheme& scheme : reference_schemes()) {
    SCOPED_TRACE(scheme.integrator);
    const auto simulation = make("name = \"coincident\"\n" + time_table(scheme.integrator, 1e-3) +
                                 "[[body]]\nname = \"rope\"\nmodel = \"mass_spring\"\n"
                                 "mesh = { shape = \"rope\", cells = [1], size = [0.5] }\n"
                                 "springs = { stiffness = 120, damping = 0.75 }\nmass = 0.25\n"
                                 "displacement = [ { select = { nodes = [1] }, value = [-0.5, 0, 0] } ]\n");
    for (int i = 0; i < 10; ++i) {
      ASSERT_TRUE(simulation->step()) << simulation->failure()->text();
      EXPECT_TRUE(simulation->state().positions.isZero(0.0));
      EXPECT_TRUE(simulation->state().velocities.isZero(0.0));
    }
    EXPECT_NEAR(simulation->calc_report().elastic, 120.0 * 0.25, 1e-12);
  }
}

TEST(Reference, C11_TinySeparationsPushApartOrNotAtAll) {
  for (const double l : {1e-160, 1e-200, 1e-300, 5e-324}) {
    for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) {
      const Vec3 f = calc_spring_force(l * n, Vec3::Zero(), r, k_s, k_d);
      ASSERT_TRUE(f.allFinite()) << l;
      if (!f.isZero(0.0)) {
        EXPECT_LE((f + k_s * n).norm(), 1e-12 * k_s) << l;
      }
      EXPECT_TRUE(calc_spring_tangent(l * n, r, k_s, Tangent::positive_semidefinite).allFinite()) << l;
    }
    const Vec3 oblique = calc_spring_force(l * Vec3(1, 1, 1), Vec3(1, 2, 3), r, k_s, k_d);
    EXPECT_TRUE(oblique.allFinite()) << l;
  }
}

TEST(Reference, C11_HugeSeparationsAreFiniteOrNamed) {
  EXPECT_TRUE(calc_spring_force(Vec3(1e200, 0, 0), Vec3::Zero(), r, k_s, k_d).allFinite());
  for (const char* displacement : {"1e200", "1e300"}) {
    for (const ReferenceScheme& scheme : reference_schemes()) {
      SCOPED_TRACE(concat(scheme.integrator, " ", displacement));
      const Result<Scene> scene = load_scene_text(
          "name = \"far\"\n" + time_table(scheme.integrator, 1e-3) +
          "[[body]]\nname = \"rope\"\nmodel = \"mass_spring\"\nmesh = { shape = \"rope\", cells = [1], size = [0.5] }\n"
          "springs = { stiffness = 120, damping = 0.75 }\nmass = 0.25\n"
          "displacement = [ { select = { nodes = [1] }, value = [" +
          std::string(displacement) + ", 0, 0] } ]\n");
      if (!scene) continue;  // refused with a reason
      Simulation& simulation = *scene.value().simulation;
      for (int i = 0; i < 10; ++i) {
        const bool stepped = simulation.step();
        EXPECT_TRUE(simulation.state().positions.allFinite());
        EXPECT_TRUE(simulation.state().velocities.allFinite());
        EXPECT_TRUE(stepped || !simulation.failure()->cause.empty());
        if (stepped) {
          EXPECT_TRUE(std::isfinite(calc_energy(simulation)));
        }
      }
    }
  }
}

}  // namespace
}  // namespace flexcast::test
