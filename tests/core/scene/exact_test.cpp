// The key `exact`, and what a loaded scene says of its meshes.
#include <gtest/gtest.h>

#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

TEST(Exact, IsNoneUnlessTheSceneNamesOne) {
  EXPECT_EQ(loaded(valid_scene).exact, "");
  EXPECT_EQ(loaded("exact = \"linear_modes\"\n" + valid_scene).exact, "linear_modes");
  EXPECT_EQ(loaded(valid_scene, {"exact=free_flight"}).exact, "free_flight");
}

TEST(Exact, ThatIsUnknownIsRefusedWithWhatThereIs) {
  const std::string message = refusal("exact = \"linear_mode\"\n" + valid_scene);
  EXPECT_TRUE(message.starts_with("test.toml:1: ")) << message;
  for (const char* words : {"exact", "linear_mode", "free_flight", "linear_modes"})
    EXPECT_NE(message.find(words), std::string::npos) << message;
}

TEST(SceneMeshes, SayHowTheyWereMade) {
  const Scene scene = loaded(valid_scene);
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].body, "beam");
  EXPECT_TRUE(scene.meshes[0].fem);
  EXPECT_EQ(scene.meshes[0].cells, (std::vector<std::int64_t>{2, 1, 1}));
  EXPECT_EQ(scene.meshes[0].file, "");
  EXPECT_FALSE(scene.meshes[1].fem);
}

TEST(SceneMeshes, SayWhetherSelectorsCountOnNodeNumbers) {
  EXPECT_FALSE(loaded(valid_scene).meshes[0].names_nodes);
  for (const char* entry :
       {"beam.pin=[{ select = { nodes = [0] } }]", "beam.force=[{ select = { nodes = [0] }, value = [1, 0, 0] }]",
        "beam.handle=[{ name = \"grip\", select = { nodes = [0] } }]"}) {
    EXPECT_TRUE(loaded(valid_scene, {entry}).meshes[0].names_nodes) << entry;
    EXPECT_FALSE(loaded(valid_scene, {entry}).meshes[1].names_nodes) << entry;
  }
}

}  // namespace
}  // namespace flexcast::test
