// Grabs: a particle is pulled to a place until it is let go.
#include <gtest/gtest.h>

#include <cmath>

#include "core/integrators/integrator.h"
#include "tests/support/everything.h"

namespace flexcast::test {
namespace {

// A soft damped cube without weight, and a rope far away.
std::string scene_text(std::string_view integrator, double step = 1e-3) {
  return concat("name = \"grab\"\n[time]\nstep = ", step, "\nintegrator = \"", integrator, R"("
[solver]
newton_tolerance = 1e-8
iterations = 20
[[body]]
name = "cube"
model = "fem"
mesh = { shape = "beam", cells = [2, 2, 2], size = [0.2, 0.2, 0.2] }
material = { law = "corotational", young = 2e4, poisson = 0.3, density = 1000.0 }
damping = { mass = 8.0, stiffness = 1e-3 }
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [4], size = [1.0] }
springs = { stiffness = 20.0 }
mass = 0.05
origin = [5, 0, 0]
pin = [ { select = { nodes = [0] } }, { select = { nodes = [1] }, axes = "z" } ]
handle = [ { name = "grip", select = { nodes = [4] } } ]
)");
}

constexpr std::int64_t corner = 26, rope = 27;

TEST(Grab, TakesItsParticleToTheTargetAndTheBodyFollows) {
  for (const IntegratorRow& row : integrators()) {
    if (row.name == "forward_euler") continue;
    SCOPED_TRACE(row.name);
    const auto simulation = make(scene_text(row.name, row.implicit ? 5e-3 : 1e-3));
    const Vec3 target(0.6, 0.1, 0.5), center = simulation->calc_body_reports()[0].center_of_mass;
    ASSERT_TRUE(simulation->grab(corner, target).ok());
    run(*simulation, static_cast<int>(3.0 / simulation->settings().time.step));
    EXPECT_LE((position(*simulation, corner) - target).norm(), 2e-3);
    EXPECT_GE((simulation->calc_body_reports()[0].center_of_mass - center).norm(), 0.3);
    EXPECT_EQ(simulation->calc_report().inverted, 0);
  }
}

TEST(Grab, OfTheSameParticleMovesItsTargetAndKeepsItsStiffness) {
  const auto simulation = make(scene_text("symplectic_euler"));
  ASSERT_TRUE(simulation->grab(corner, Vec3(0, 0, 1), 50.0).ok());
  ASSERT_TRUE(simulation->grab(corner, Vec3(0, 0, 2)).ok());
  ASSERT_EQ(simulation->grabs().size(), 1u);
  EXPECT_EQ(simulation->grabs()[0].target, Vec3(0, 0, 2));
  EXPECT_EQ(simulation->grabs()[0].stiffness, 50.0);
  ASSERT_TRUE(simulation->grab(0, Vec3(0, 0, 0)).ok());
  EXPECT_EQ(simulation->grabs().size(), 2u);
}

TEST(Grab, ReleasedLetsGo) {
  const auto simulation = make(scene_text("rk4"));
  ASSERT_TRUE(simulation->set_parameters(std::vector<ParameterAssignment>{{"cube.damping.mass", 0.0}}).ok());
  ASSERT_TRUE(simulation->grab(corner, Vec3(1, 0, 0)).ok());
  run(*simulation, 50);
  ASSERT_TRUE(simulation->release(corner).ok());
  const Vec3 momentum = simulation->calc_report().momentum;
  EXPECT_GT(momentum.norm(), 0.1);
  // The rope rests.
  run(*simulation, 100);
  EXPECT_LE((simulation->calc_report().momentum - momentum).norm(), 1e-11 * momentum.norm());
  const auto again = simulation->release(corner);
  ASSERT_FALSE(again.ok());
  EXPECT_EQ(again.error().message, "particle 26 is not grabbed");
}

TEST(Grab, ClosesTheBooks) {
  for (const IntegratorRow& row : integrators()) {
    const auto simulation = make(everything_text(row.name, 2e-4));
    const auto calc_balance = [&] {
      const StepReport r = simulation->calc_report();
      return r.kinetic + r.elastic + r.gravity + r.contact - r.work + r.dissipated - r.numerical;
    };
    const double start = calc_balance();
    const auto expect_closed = [&](const char* when) {
      const StepReport r = simulation->calc_report();
      const double scale = r.kinetic + r.elastic + r.dissipated + std::abs(r.gravity) + std::abs(r.work);
      EXPECT_NEAR(calc_balance(), start, 1e-11 * scale) << row.name << " " << when;
    };
    ASSERT_TRUE(simulation->grab(7, Vec3(0.5, 0.5, 0.8)).ok());
    expect_closed("grabbed");
    run(*simulation, 40);
    ASSERT_TRUE(simulation->grab(7, Vec3(0, 0, 1)).ok());
    run(*simulation, 40);
    expect_closed("moved");
    ASSERT_TRUE(simulation->release(7).ok());
    run(*simulation, 20);
    expect_closed("released");
  }
}

TEST(Grab, RefusesWhatCannotBe) {
  const auto simulation = make(scene_text("symplectic_euler"));
  const auto message = [&](std::int64_t particle, const Vec3& target, double stiffness) {
    const auto result = simulation->grab(particle, target, stiffness);
    return result ? std::string() : result.error().message;
  };
  const Vec3 here(0, 0, 0);
  EXPECT_EQ(message(-1, here, 0), "there is no particle -1 (allowed: 0 to 31)");
  EXPECT_EQ(message(32, here, 0), "there is no particle 32 (allowed: 0 to 31)");
  for (const std::int64_t held : {rope, rope + 1, rope + 4})
    EXPECT_EQ(message(held, here, 0), "particle " + std::to_string(held) + " is held by a pin or a handle");
  EXPECT_NE(message(0, Vec3(0, NAN, 0), 0).find("target"), std::string::npos);
  EXPECT_NE(message(0, Vec3(0, INFINITY, 0), 0).find("target"), std::string::npos);
  for (const double stiffness : {-1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)})
    EXPECT_NE(message(0, here, stiffness).find("stiffness"), std::string::npos) << stiffness;
  EXPECT_TRUE(simulation->grabs().empty());
}

TEST(Grab, EndsWithAReset) {
  const auto simulation = make(scene_text("bdf2")), plain = make(scene_text("bdf2"));
  ASSERT_TRUE(simulation->grab(corner, Vec3(1, 0, 0)).ok());
  run(*simulation, 5);
  simulation->reset();
  EXPECT_TRUE(simulation->grabs().empty());
  run(*simulation, 5);
  run(*plain, 5);
  EXPECT_EQ(simulation->calc_state_hash(), plain->calc_state_hash());
}

// Whichever particle, with the step close to the limit.
TEST(Grab, KeepsExplicitSchemesStable) {
  const auto probe = make(scene_text("symplectic_euler"));
  const double limit = probe->calc_stable_step();
  for (std::int64_t particle = 0; particle < 27; particle += 13) {
    const auto simulation = make(scene_text("symplectic_euler", 0.9 * limit));
    ASSERT_TRUE(simulation->grab(particle, Vec3(0.3, 0.2, 0.4)).ok());
    run(*simulation, 2000);
    EXPECT_LT(simulation->calc_report().kinetic, 10.0) << particle;
    EXPECT_GE(simulation->calc_report().stability_margin.value(), 1.0) << particle;
  }
}

}  // namespace
}  // namespace flexcast::test
