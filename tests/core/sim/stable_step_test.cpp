// The advertised step against the true limit of the linearised scene: the smallest h at which the amplification matrix
// of the whole scene has an eigenvalue beyond 1.
#include <gtest/gtest.h>

#include "core/integrators/integrator.h"
#include "tests/support/amplification.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

struct Case {
  const char* name;
  std::string bodies;
};

const std::vector<Case>& cases() {
  const auto beam = [](const std::string& more) {
    return "[[body]]\nname = \"beam\"\nmodel = \"fem\"\nmesh = { shape = \"beam\", cells = [2, 1, 1], size = [1, 0.5, "
           "0.3] }\nmaterial = { law = \"corotational\", young = 1e4, poisson = 0.3, density = 500 }\n" +
           more;
  };
  const auto sheet = [](const std::string& damping, const std::string& more) {
    return "[[body]]\nname = \"sheet\"\nmodel = \"mass_spring\"\nmesh = { shape = \"grid\", cells = [2, 2], size = [1, "
           "0.7] }\nsprings = { stiffness = 40, damping = " +
           damping + " }\nmass = 0.1\n" + more;
  };
  const std::string pinned = "pin = [ { select = { nodes = [0, 3] } } ]\n";
  const std::string heavy = "particle_mass = [ { select = { nodes = [4] }, value = 100.0 } ]\n";
  const std::string light = "particle_mass = [ { select = { nodes = [4] }, value = 1e-3 } ]\n";
  static const std::vector<Case> list = {
      {"free_beam", beam("")},
      {"pinned_beam", beam(pinned)},
      {"beam_with_mass_damping", beam(pinned + "damping = { mass = 3.0 }\n")},
      {"beam_with_weak_stiffness_damping", beam(pinned + "damping = { stiffness = 1e-3 }\n")},
      {"beam_with_strong_stiffness_damping", beam(pinned + "damping = { stiffness = 0.5 }\n")},
      {"beam_with_drag", beam("drag = 5.0\n")},
      {"beam_with_everything_and_a_heavy_node",
       beam(pinned + heavy + "drag = 0.5\ndamping = { mass = 1.0, stiffness = 0.01 }\n")},
      {"free_sheet", sheet("0.0", "")},
      {"damped_sheet", sheet("0.3", pinned)},
      {"overdamped_sheet", sheet("30.0", pinned)},
      {"damped_sheet_with_a_light_node", sheet("0.3", light)},
      {"sheet_with_drag_and_a_heavy_node", sheet("0.0", heavy + "drag = 0.4\n")},
      {"heavily_dragged_sheet", sheet("0.1", pinned + "drag = 60.0\n")},
      {"beam_and_overdamped_sheet", beam("damping = { mass = 2.0 }\n") + sheet("30.0", "")},
      {"undamped_beam_and_damped_sheet", beam("") + sheet("1.0", "")}};
  return list;
}

class StableStep : public testing::TestWithParam<Case> {};

TEST_P(StableStep, IsNeverAboveTheTrueLimitAndNotFarBelow) {
  for (const IntegratorRow& row : integrators()) {
    if (row.implicit) continue;
    SCOPED_TRACE(row.name);
    const auto simulation = make("name = \"stable\"\n" + time_table(row.name, 1e-3) + GetParam().bodies);
    const double advertised = simulation->calc_stable_step();
    const Linearised scene = linearise(simulation->model());
    ASSERT_FALSE(std::isnan(advertised));
    if (advertised == 0.0) {  // undamped forward Euler
      EXPECT_FALSE(is_stable(row.name, scene, 1e-2));
      continue;
    }
    EXPECT_TRUE(is_stable(row.name, scene, 0.5 * advertised));
    EXPECT_TRUE(is_stable(row.name, scene, advertised));
    EXPECT_FALSE(is_stable(row.name, scene, advertised / 0.95)) << "advertised " << advertised;
  }
}

TEST(StableStepLimit, OfASceneStifferThanAnyNumberIsZero) {
  for (const IntegratorRow& row : integrators()) {
    if (row.implicit) continue;
    const auto simulation = make("name = \"stiff\"\n" + time_table(row.name, 1e-3) + cases()[8].bodies);
    ASSERT_TRUE(simulation->set_parameters(std::vector<ParameterAssignment>{{"sheet.stiffness", 1e307}}).ok());
    EXPECT_LE(simulation->calc_stable_step(), 1e-150) << row.name;
    EXPECT_FALSE(simulation->calc_warnings().empty());
  }
}

// The air hardly damps a rope whose springs damp a thousand times as much: the limit is that without air.
TEST(StableStepLimit, FeelsLittleOfWhatDampsLittle) {
  const auto limit = [](std::string_view scheme, double drag) {
    const auto simulation = make("name = \"rope\"\n" + time_table(scheme, 1e-3) +
                                 "[[body]]\nname = \"rope\"\nmodel = \"mass_spring\"\nmesh = { shape = \"rope\", cells "
                                 "= [40], size = [1.0] }\nsprings = { stiffness = 400.0, damping = 0.05 }\n"
                                 "total_mass = 0.2\npin = [ { select = { nodes = [0] } } ]\n" +
                                 concat("drag = ", drag, "\n"));
    return simulation->calc_stable_step();
  };
  for (const char* scheme : {"forward_euler", "symplectic_euler", "velocity_verlet", "rk4"}) {
    EXPECT_NEAR(limit(scheme, 2e-4) / limit(scheme, 0.0), 1.0, 0.002) << scheme;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryScene, StableStep, testing::ValuesIn(cases()),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace flexcast::test
