// What a scene does not name costs nothing, and what it names and puts to nothing costs as little: the same forces act,
// the schemes iterate as often, and every bit is the same.
#include <gtest/gtest.h>

#include <typeinfo>

#include "core/forces/system.h"
#include "core/integrators/integrator.h"
#include "tests/core/lab/cost/cost_scenes.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

std::vector<std::string> list_active_forces(const Simulation& simulation) {
  const System system(simulation.model());
  std::vector<std::string> names;
  for (const Force* force : system.active_forces()) names.emplace_back(typeid(*force).name());
  return names;
}

// What a scheme asks a system for follows from these and the state alone.
struct Structure {
  std::vector<std::string> forces;
  bool damping = false, friction = false, handles = false;
  bool operator==(const Structure&) const = default;
};
Structure calc_structure(const Simulation& simulation) {
  const System system(simulation.model());
  return {list_active_forces(simulation), system.has_damping(), system.has_friction(), system.has_handles()};
}

class CostsNothing : public testing::TestWithParam<std::string> {};

TEST_P(CostsNothing, WhatIsNamedAndPutToNothing) {
  const auto never = make(bare(GetParam()));
  const auto named = std::move(load_scene_text(bare(GetParam()), "scene", ".", nothing()).value().simulation);
  EXPECT_EQ(calc_structure(*named), calc_structure(*never));
  EXPECT_EQ(calc_structure(*never), (Structure{list_active_forces(*never)}));
  EXPECT_EQ(calc_structure(*never).forces.size(), 2u);  // one elastic force a body
  for (int i = 0; i < 40; ++i) {
    ASSERT_EQ(never->step(), named->step());
    ASSERT_EQ(never->calc_state_hash(), named->calc_state_hash()) << i;
    EXPECT_EQ(never->statistics().iterations, named->statistics().iterations);
    EXPECT_EQ(never->statistics().linear_iterations, named->statistics().linear_iterations);
  }
}

std::vector<std::string> list_integrators() {
  std::vector<std::string> names;
  for (const IntegratorRow& row : integrators()) names.emplace_back(row.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Schemes, CostsNothing, testing::ValuesIn(list_integrators()),
                         [](const auto& scheme) { return scheme.param; });

// A live change to nothing is as good as never having named it.
TEST(CostsNothing, WhatAParameterPutsToNothingWhileTheSceneRuns) {
  const auto simulation = std::move(load_scene_text(everything).value().simulation);
  const Structure before = calc_structure(*simulation);
  ASSERT_TRUE(simulation->set_parameters(std::vector<ParameterAssignment>{{"gravity", Vec3(0, 0, 0)},
                                                                          {"beam.damping.mass", 0.0},
                                                                          {"beam.damping.stiffness", 0.0},
                                                                          {"rope.damping", 0.0},
                                                                          {"rope.drag", 0.0},
                                                                          {"contact.ground.friction", 0.0}}));
  const Structure after = calc_structure(*simulation);
  EXPECT_TRUE(before.damping && before.friction);
  EXPECT_FALSE(after.damping || after.friction);
  EXPECT_LT(after.forces.size(), before.forces.size());
}

}  // namespace
}  // namespace flexcast::test
