// Bodies made of a Wavefront file: cloth, and nothing else.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/scene/scene.h"

namespace flexcast {
namespace {

class SurfaceFile : public testing::Test {
 protected:
  SurfaceFile() : folder_(std::filesystem::temp_directory_path() / ("flexcast_surface_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "flag.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  }
  ~SurfaceFile() override { std::filesystem::remove_all(folder_); }

  Result<Scene> load(const std::string& model, const std::string& keys) const {
    return load_scene_text("name = \"flag\"\n[[body]]\nname = \"flag\"\nmodel = \"" + model +
                               "\"\nmesh = { file = \"flag.obj\", scale = 2.0 }\n" + keys,
                           "test.toml", folder_, {});
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(SurfaceFile, IsClothOfTheFilesSpringsInTheScenesScale) {
  const auto scene = load("mass_spring", "springs = { stiffness = 10.0 }\nmass = 0.1\n");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const Model& model = scene.value().simulation->model();
  EXPECT_EQ(model.springs.size(), 6u);  // four edges, two diagonals
  EXPECT_EQ(model.triangles.size(), 2u);
  EXPECT_EQ(model.rest_positions[3], 2.0);
  ASSERT_EQ(scene.value().files.size(), 1u);
  EXPECT_EQ(scene.value().files[0].name, "flag.obj");
}

TEST_F(SurfaceFile, IsRefusedWhereTetrahedraAreNeeded) {
  const auto scene = load("fem", "material = { law = \"linear\", young = 1e5, poisson = 0.3, density = 1000.0 }\n");
  ASSERT_FALSE(scene.ok());
  const std::string& message = scene.error().message;
  EXPECT_TRUE(message.starts_with("test.toml:5: [[body]] \"flag\": mesh.file = \"flag.obj\" is a surface")) << message;
  EXPECT_NE(message.find("needs tetrahedra"), std::string::npos) << message;
}

}  // namespace
}  // namespace flexcast
