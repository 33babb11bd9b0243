// Every scene of server/scenes loads and runs; a new one is tested by being there.
#include <fstream>
#include <set>

#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

std::vector<std::string> shipped_scenes() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(FLEXCAST_SOURCE_DIR "/server/scenes"))
    if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
  return {names.begin(), names.end()};
}

class ShippedScene : public testing::TestWithParam<std::string> {
 protected:
  std::filesystem::path path() const { return FLEXCAST_SOURCE_DIR "/server/scenes/" + GetParam() + ".toml"; }
};

TEST_P(ShippedScene, RunsTwentyStepsWithoutWarning) {
  auto loaded_scene = load_scene(path());
  ASSERT_TRUE(loaded_scene.ok()) << loaded_scene.error().message;
  Simulation& simulation = *loaded_scene.value().simulation;
  EXPECT_EQ(simulation.calc_warnings(), std::vector<std::string>{});
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(simulation.step()) << simulation.failure()->text();
  EXPECT_TRUE(simulation.state().positions.allFinite());
}

TEST_P(ShippedScene, IsNamedLikeItsFileSaysWhatItShowsAndHasAProbe) {
  const auto loaded_scene = load_scene(path());
  ASSERT_TRUE(loaded_scene.ok()) << loaded_scene.error().message;
  EXPECT_EQ(loaded_scene.value().name, GetParam());
  EXPECT_FALSE(loaded_scene.value().description.empty());
  EXPECT_TRUE(loaded_scene.value().text.starts_with("# "));
  EXPECT_FALSE(loaded_scene.value().simulation->probes().empty());
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, testing::ValuesIn(shipped_scenes()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace flexcast::test
