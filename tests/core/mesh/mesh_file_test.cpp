#include "core/mesh/mesh_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "core/mesh/topology.h"
#include "tests/core/mesh/mesh_texts.h"

namespace flexcast {
namespace {

using namespace mesh_texts;

class MeshFiles : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::temp_directory_path() / ("flexcast_mesh_" + name + "_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  std::filesystem::path folder_;
};

TEST_F(MeshFiles, AreToldApartBySuffix) {
  const auto gmsh = read_mesh_file(write("a.msh", corner_41));
  ASSERT_TRUE(gmsh.ok()) << gmsh.error().message;
  EXPECT_EQ(gmsh.value().files, (std::vector{folder_ / "a.msh"}));
  write("b.1.node", corner_node);
  write("b.1.ele", corner_ele);
  for (const char* name : {"b.1.node", "b.1.ele"}) {
    const auto tetgen = read_mesh_file(folder_ / name);
    ASSERT_TRUE(tetgen.ok()) << tetgen.error().message;
    EXPECT_EQ(tetgen.value().files, (std::vector{folder_ / "b.1.node", folder_ / "b.1.ele"}));
    EXPECT_EQ(tetgen.value().mesh.tetrahedra, gmsh.value().mesh.tetrahedra);
  }
}

TEST_F(MeshFiles, OfUnknownSuffixAreRefusedNamingTheKnownOnes) {
  expect_refused(read_mesh_file(write("a.stl", "solid")), {"a.stl", "'.stl'", ".msh", ".node", ".ele"});
  expect_refused(read_mesh_file(write("plain", "")), {"plain", "''"});
}

TEST_F(MeshFiles, ThatCannotBeReadAreRefusedByName) {
  expect_refused(read_mesh_file(folder_ / "none.msh"), {"none.msh", "no such file"});
  std::filesystem::create_directory(folder_ / "folder.msh");
  expect_refused(read_mesh_file(folder_ / "folder.msh"), {"folder.msh", "not a regular file"});
}

TEST_F(MeshFiles, WithoutTheirPartnerAreRefusedNamingThePartner) {
  expect_refused(read_mesh_file(write("a.node", corner_node)), {"a.ele", "no such file"});
  expect_refused(read_mesh_file(write("b.ele", corner_ele)), {"b.node", "no such file"});
}

TEST_F(MeshFiles, TooLargeAreRefusedBeforeTheyAreRead) {
  write("huge.msh", "");
  std::error_code code;
  std::filesystem::resize_file(folder_ / "huge.msh", std::uintmax_t{1} << 40, code);
  if (code) GTEST_SKIP() << "this file system has no sparse files";
  expect_refused(read_mesh_file(folder_ / "huge.msh"), {"huge.msh", "1099511627776 bytes"});
}

TEST(BunnyMesh, IsAClosedVolumeStandingOnTheGround) {
  const auto file = read_mesh_file(std::filesystem::path(FLEXCAST_SOURCE_DIR) / "server/scenes/meshes/bunny.node");
  ASSERT_TRUE(file.ok()) << file.error().message;
  const Mesh& mesh = file.value().mesh;
  EXPECT_TRUE(file.value().repairs.empty());
  EXPECT_EQ(mesh.nodes.size(), 2579u);
  EXPECT_EQ(mesh.tetrahedra.size(), 9293u);
  EXPECT_EQ(mesh.triangles.size(), 3674u);

  double lowest = 1.0;
  double highest = -1.0;
  for (const Vec3& node : mesh.nodes) {
    lowest = std::min(lowest, node.z());
    highest = std::max(highest, node.z());
  }
  EXPECT_EQ(lowest, 0.0);
  EXPECT_NEAR(highest, 0.1545, 1e-4);

  double volume = 0.0;
  for (const Tetrahedron& tetrahedron : mesh.tetrahedra) volume += calc_six_volumes(mesh.nodes, tetrahedron) / 6.0;
  EXPECT_NEAR(volume, 7.958e-4, 1e-7);
  std::set<Spring> edges;  // each directed edge of a closed surface has its opposite
  for (const auto& [a, b, c] : mesh.triangles) edges.insert({{a, b}, {b, c}, {c, a}});
  EXPECT_EQ(edges.size(), 3 * mesh.triangles.size());
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.count({b, a}));
}

}  // namespace
}  // namespace flexcast
