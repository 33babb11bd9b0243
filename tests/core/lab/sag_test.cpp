// The bending beam that is shipped gives the answers that its comment promises.
#include <gtest/gtest.h>

#include "core/lab/statics.h"
#include "core/scene/scene.h"

namespace flexcast::test {
namespace {

// Converged on finer meshes of quadratic tetrahedra: the static tip, and the dynamic one at 0.5 s.
constexpr double hanging = -0.6301, swinging = -0.86;  // m

class Sag : public testing::Test {
 protected:
  void SetUp() override {
    auto scene = load_scene(FLEXCAST_SOURCE_DIR "/server/scenes/sag.toml");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    simulation_ = std::move(scene.value().simulation);
    ASSERT_EQ(simulation_->probes().size(), 1u);
    const std::int32_t tip = simulation_->probes()[0].particle;
    EXPECT_LE((block3(simulation_->model().rest_positions, tip) - Vec3(1.0, 0.0625, 0.0625)).norm(), 1e-12);
  }

  // How far the tip is above where it starts, m.
  double calc_tip() const {
    const std::int32_t tip = simulation_->probes()[0].particle;
    return block3(simulation_->state().positions, tip).z() - block3(simulation_->model().rest_positions, tip).z();
  }

  std::unique_ptr<Simulation> simulation_;
};

TEST_F(Sag, HangsAtRestWithinAHundredthOfTheConvergedDepth) {
  ASSERT_TRUE(solve_static(*simulation_));
  EXPECT_NEAR(calc_tip(), -0.6254, 1e-4);
  EXPECT_NEAR(calc_tip(), hanging, 0.01 * -hanging);
}

TEST_F(Sag, SwingsThroughTheConvergedPlaceWithinAHundredth) {
  while (simulation_->state().step < 50) ASSERT_TRUE(simulation_->step());
  EXPECT_NEAR(simulation_->state().time, 0.5, 1e-12);
  EXPECT_NEAR(calc_tip(), -0.856, 5e-4);
  EXPECT_NEAR(calc_tip(), swinging, 0.01 * -swinging);
}

}  // namespace
}  // namespace flexcast::test
