// Once a scene has taken its first steps, further ones ask for no memory.
#include <gtest/gtest.h>

#include "core/integrators/integrator.h"
#include "tests/allocation/counter.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

// The direct solver allocates inside Eigen; scenes of more than 1,000 particles take this one. Steps are such that
// implicit schemes iterate and explicit ones are stable.
std::string make_head(std::string_view integrator) {
  const double step = find_integrator(integrator)->implicit ? 0.01 : 1e-4;
  return concat("name = \"scene\"\ngravity = [0, 0, -9.81]\n[time]\nstep = ", step, "\nintegrator = \"", integrator,
                "\"\n[solver]\nlinear = \"pcg\"\n");
}

std::string beam_scene(std::string_view integrator, std::string_view element) {
  return concat(make_head(integrator), R"(
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [6, 2, 2], size = [1.0, 0.25, 0.25] }
material = { law = "neo_hookean", young = 1e5, poisson = 0.4, density = 1000.0 }
damping = { mass = 0.1, stiffness = 1e-4 }
pin = [ { select = { box = [[-1e-9, -1, -1], [1e-9, 1, 1]] } } ]
)",
                "element = \"", element, "\"\n");
}

std::string cloth_scene(std::string_view integrator) {
  return concat(make_head(integrator), R"(
[[body]]
name = "cloth"
model = "mass_spring"
mesh = { shape = "grid", cells = [8, 8], size = [1.0, 1.0] }
springs = { stiffness = 5.0, damping = 0.01 }
mass = 0.001
drag = 1e-4
pin = [ { select = { nodes = [0, 8] } } ]
)");
}

std::int64_t count_allocations_of_steps(const std::string& scene) {
  const std::unique_ptr<Simulation> simulation = make(scene);
  run(*simulation, 2);
  const std::int64_t before = allocation_count();
  for (int i = 0; i < 5; ++i) {
    if (!simulation->step()) throw std::runtime_error(simulation->failure()->text());
  }
  return allocation_count() - before;
}

class Allocation : public testing::TestWithParam<std::string_view> {
 protected:
  void SetUp() override {
    if (!counts_allocations()) GTEST_SKIP() << "the allocator belongs to a sanitizer";
  }
};

TEST(AllocationCounter, SeesOperatorNewAndEigen) {
  if (!counts_allocations()) GTEST_SKIP() << "the allocator belongs to a sanitizer";
  const std::int64_t before = allocation_count();
  VecX vector = VecX::Zero(1000);
  EXPECT_EQ(allocation_count() - before, 1);
  const auto number = std::make_unique<double>(vector.sum());
  EXPECT_EQ(allocation_count() - before, 2);
  EXPECT_EQ(*number, 0.0);
}

TEST_P(Allocation, EndsAfterTwoStepsOfABeam) {
  EXPECT_EQ(count_allocations_of_steps(beam_scene(GetParam(), "tet4")), 0);
}

TEST_P(Allocation, EndsAfterTwoStepsOfAQuadraticBeam) {
  EXPECT_EQ(count_allocations_of_steps(beam_scene(GetParam(), "tet10")), 0);
}

TEST_P(Allocation, EndsAfterTwoStepsOfACloth) {
  EXPECT_EQ(count_allocations_of_steps(cloth_scene(GetParam())), 0);
}

std::vector<std::string_view> integrator_names() {
  std::vector<std::string_view> names;
  for (const IntegratorRow& row : integrators()) names.push_back(row.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(EveryIntegrator, Allocation, testing::ValuesIn(integrator_names()),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace flexcast::test
