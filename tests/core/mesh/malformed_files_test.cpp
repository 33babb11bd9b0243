// Whatever the bytes: an error with a text, or a mesh that keeps its promises. Sanitizers look for the rest.
#include <gtest/gtest.h>

#include "core/mesh/topology.h"
#include "tests/core/mesh/mesh_texts.h"

namespace flexcast {
namespace {

using namespace mesh_texts;

void expect_error_or_mesh(const Result<MeshFile>& result) {
  if (!result.ok()) {
    EXPECT_FALSE(result.error().message.empty());
    EXPECT_LT(result.error().message.size(), 600u);
    return;
  }
  const Mesh& mesh = result.value().mesh;
  ASSERT_FALSE(mesh.tetrahedra.empty());
  for (const Tetrahedron& tetrahedron : mesh.tetrahedra) {
    for (std::int32_t node : tetrahedron) {
      ASSERT_GE(node, 0);
      ASSERT_LT(static_cast<std::size_t>(node), mesh.nodes.size());
      ASSERT_TRUE(mesh.nodes[node].allFinite());
    }
  }
}

// Calls read(bytes) for the bytes cut at every place, and with every byte changed in several ways.
template <class Read>
void try_all_damages(const std::string& bytes, Read read) {
  for (std::size_t size = 0; size < bytes.size(); ++size) read(bytes.substr(0, size));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (unsigned flip : {0x01u, 0x10u, 0x80u, 0xffu}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ flip);
      read(damaged);
    }
    for (char replacement : {'-', '9', '\n', '$', ' '}) {
      std::string damaged = bytes;
      damaged[at] = replacement;
      read(damaged);
    }
  }
}

class DamagedGmshFile : public testing::TestWithParam<const char*> {};

TEST_P(DamagedGmshFile, IsAnErrorOrAMesh) {
  const FileContent file = data_file(GetParam());
  try_all_damages(file.bytes, [&](const std::string& bytes) {
    expect_error_or_mesh(read_gmsh_file({file.name, bytes}));
  });
}

INSTANTIATE_TEST_SUITE_P(MalformedFiles, DamagedGmshFile,
                         testing::Values("cube_22_ascii.msh", "cube_22_binary.msh", "cube_41_ascii.msh",
                                         "cube_41_binary.msh"),
                         [](const auto& tested) {
                           const std::string name = tested.param;
                           return name.substr(0, name.find('.'));
                         });

class DamagedVtkFile : public testing::TestWithParam<const char*> {};

TEST_P(DamagedVtkFile, IsAnErrorOrAMesh) {
  const FileContent file = data_file(GetParam());
  try_all_damages(file.bytes, [&](const std::string& bytes) {
    expect_error_or_mesh(read_vtk_file({file.name, bytes}));
  });
}

INSTANTIATE_TEST_SUITE_P(MalformedFiles, DamagedVtkFile,
                         testing::Values("cube_42_ascii.vtk", "cube_42_binary.vtk", "cube_51_ascii.vtk",
                                         "cube_51_binary.vtk", "cube_ascii_plain.vtu", "cube_binary_zlib.vtu",
                                         "cube_appended_zlib.vtu", "cube_appended64_plain.vtu"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

TEST(MalformedFiles, ADamagedSurfaceIsAnErrorOrCloth) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 1 1 1\nvn 0 0 1\nf 1/2/3 2//1 -2 \\\n 4\nf 1 2 -1\n";
  try_all_damages(text, [](const std::string& bytes) {
    const auto file = read_obj_text(bytes);
    if (!file.ok()) {
      EXPECT_FALSE(file.error().message.empty());
      return;
    }
    const auto nodes = static_cast<std::int32_t>(file.value().mesh.nodes.size());
    for (const auto& [p, q] : file.value().mesh.springs) ASSERT_TRUE(0 <= p && p < q && q < nodes);
    ASSERT_FALSE(file.value().mesh.triangles.empty());
  });
}

TEST(MalformedFiles, EveryCutOfAGmshFileIsRefused) {
  for (const char* name : {"cube_22_ascii.msh", "cube_22_binary.msh", "cube_41_ascii.msh", "cube_41_binary.msh"}) {
    const FileContent file = data_file(name);
    // Without its last line end a file is still whole.
    for (std::size_t size = 0; size + 1 < file.bytes.size(); ++size) {
      EXPECT_FALSE(read_gmsh_file({name, file.bytes.substr(0, size)}).ok()) << name << " cut at " << size;
    }
  }
}

TEST(MalformedFiles, ADamagedTetgenPairIsAnErrorOrAMesh) {
  const FileContent node = data_file("cube_from_1.node");
  const FileContent ele = data_file("cube_from_1.ele");
  const auto read = [](const FileContent& node_file, const FileContent& ele_file) {
    const auto numbered = parse_tetgen(node_file, ele_file);
    expect_error_or_mesh(numbered ? check_mesh(numbered.value()) : numbered.error());
  };
  try_all_damages(node.bytes, [&](const std::string& bytes) { read({node.name, bytes}, ele); });
  try_all_damages(ele.bytes, [&](const std::string& bytes) { read(node, {ele.name, bytes}); });
}

}  // namespace
}  // namespace flexcast
