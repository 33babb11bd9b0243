// Results depend neither on the number of threads nor on which instruction set with fused multiply-add does the work:
// every scheme, on scenes large enough that loops are split.
#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/integrators/integrator.h"
#include "core/sim/checkpoint.h"
#include "tests/support/instruction_set.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

class Threads : public testing::TestWithParam<std::string_view> {
 protected:
  void TearDown() override { set_thread_count(1); }

  // The state, history and books after the steps.
  static std::string run_with(int threads, const std::string& scene, std::int64_t steps) {
    set_thread_count(threads);
    const auto simulation = make(scene);
    run(*simulation, steps);
    return encode_checkpoint(simulation->save());
  }

  static void expect_same_bits(const std::string& scene, std::int64_t steps) {
    const std::string alone = run_with(1, scene, steps);
    EXPECT_EQ(run_with(2, scene, steps), alone);
    EXPECT_EQ(run_with(3, scene, steps), alone);
    for (const InstructionSet& set : fused_instruction_sets()) {
      const OnlyInstructionSet only(set.target);
      EXPECT_EQ(run_with(1, scene, steps), alone) << set.name;
    }
  }

  std::string head(double step) const {
    return concat("name = \"threads\"\ngravity = [0, 0, -9.81]\n[time]\nstep = ", step, "\nintegrator = \"", GetParam(),
                  "\"\n[solver]\nnewton_iterations = 2\niterations = 2\nlinear_tolerance = 1e-3\n");
  }
};

// 1,435 particles, held on one side and moved on the other; the middle lies on rough ground.
TEST_P(Threads, ABeamHasTheSameBitsWhoeverDoesTheWork) {
  const std::int64_t steps = GetParam() == "quasi_static" ? 10 : 50;
  expect_same_bits(head(1e-4) +
                       "[[body]]\nname = \"beam\"\nmodel = \"fem\"\n"
                       "mesh = { shape = \"beam\", cells = [40, 6, 4], size = [2, 0.3, 0.2] }\n"
                       "material = { law = \"corotational\", young = 1e5, poisson = 0.3, density = 1000 }\n"
                       "damping = { mass = 0.1, stiffness = 1e-5 }\norigin = [0, 0, -0.001]\n"
                       "velocity = [ { select = { all = true }, value = [0, 0.2, -0.1] } ]\n"
                       "pin = [ { select = { box = [[0, 0, -1], [0, 1, 1]] } } ]\n"
                       "handle = [ { name = \"grip\", select = { box = [[1.99, 0, -1], [3, 1, 1]] }, "
                       "translate = [0, 0, 0.01], rotate = [0.1, 0, 0], duration = 0.004 } ]\n"
                       "[[contact]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
                       "friction = 0.3\n",
                   steps);
}

// 2,116 particles on a rough sphere, one corner moved.
TEST_P(Threads, AClothHasTheSameBitsWhoeverDoesTheWork) {
  const std::int64_t steps = GetParam() == "quasi_static" ? 2 : 50;
  expect_same_bits(head(1e-4) +
                       "[[body]]\nname = \"cloth\"\nmodel = \"mass_spring\"\n"
                       "mesh = { shape = \"grid\", cells = [45, 45], size = [1, 1] }\n"
                       "springs = { stiffness = 10, damping = 0.005 }\ntotal_mass = 0.3\ndrag = 0.0002\n"
                       "origin = [-0.5, -0.5, 0.299]\n"
                       "handle = [ { name = \"grip\", select = { nodes = [0, 1] }, translate = [0, 0, 0.01], "
                       "duration = 0.02 } ]\n"
                       "[[contact]]\nname = \"ball\"\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.3\n"
                       "friction = 0.5\n",
                   steps);
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> names;
  for (const IntegratorRow& row : integrators()) names.push_back(row.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Schemes, Threads, testing::ValuesIn(names()),
                         [](const auto& row) { return std::string(row.param); });

}  // namespace
}  // namespace flexcast::test
