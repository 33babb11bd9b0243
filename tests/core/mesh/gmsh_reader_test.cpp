#include "core/mesh/gmsh_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/mesh/topology.h"
#include "tests/core/mesh/mesh_texts.h"

namespace flexcast {
namespace {

using namespace mesh_texts;

const std::vector<Vec3> corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(GmshReader, AllFourVariantsOfOneMeshAreIdentical) {
  const auto reference = read_gmsh_file(data_file("cube_22_ascii.msh"));
  ASSERT_TRUE(reference.ok());
  EXPECT_EQ(reference.value().mesh.nodes.size(), 14u);
  EXPECT_EQ(reference.value().mesh.tetrahedra.size(), 24u);
  EXPECT_EQ(reference.value().mesh.triangles.size(), 24u);
  EXPECT_TRUE(reference.value().repairs.empty());
  for (const char* name : {"cube_22_binary.msh", "cube_41_ascii.msh", "cube_41_binary.msh"}) {
    const auto other = read_gmsh_file(data_file(name));
    ASSERT_TRUE(other.ok()) << other.error().message;
    EXPECT_EQ(other.value().mesh.nodes, reference.value().mesh.nodes) << name;
    EXPECT_EQ(other.value().mesh.tetrahedra, reference.value().mesh.tetrahedra) << name;
    EXPECT_EQ(other.value().mesh.triangles, reference.value().mesh.triangles) << name;
    EXPECT_TRUE(other.value().mesh.springs.empty()) << name;
  }
}

TEST(GmshReader, TheCubeOfGmshHasVolumeOne) {
  const auto file = read_gmsh_file(data_file("cube_41_binary.msh"));
  ASSERT_TRUE(file.ok());
  double volume = 0.0;
  for (const auto& tetrahedron : file.value().mesh.tetrahedra) {
    volume += calc_six_volumes(file.value().mesh.nodes, tetrahedron) / 6.0;
  }
  EXPECT_NEAR(volume, 1.0, 1e-14);
}

TEST(GmshReader, ReadsOneTetrahedronOfEitherVersion) {
  for (const std::string& text : {corner_22, corner_41}) {
    const auto file = read_gmsh_text(text);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(file.value().mesh.nodes, corner);
    EXPECT_EQ(file.value().mesh.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  }
}

TEST(GmshReader, KeepsTheOrderOfNodesWithSparseNumbers) {
  const auto file = read_gmsh_text(format_22 +
                                   "$Nodes\n4\n900 0 0 0\n7 1 0 0\n12000000000 0 1 0\n8 0 0 1\n$EndNodes\n"
                                   "$Elements\n1\n5 4 2 0 1 900 7 12000000000 8\n$EndElements\n");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().mesh.nodes, corner);
  EXPECT_EQ(file.value().mesh.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
}

TEST(GmshReader, IgnoresPointsLinesAndSurfaces) {
  const auto file = read_gmsh_text(format_22 + corner_nodes_22 +
                                   "$Elements\n5\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 2 2 0 1 1 2 3\n4 3 2 0 1 1 2 3 4\n"
                                   "5 4 0 1 2 3 4\n$EndElements\n");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().mesh.tetrahedra.size(), 1u);
}

TEST(GmshReader, IgnoresOtherSectionsWhereverTheyStand) {
  const std::string other = "$Comments\nfrom nowhere\n$Nodes are here\n$EndComments\n";
  const std::string physical = "$PhysicalNames\n1\n3 1 \"rubber\"\n$EndPhysicalNames\n";
  const std::string data = "$NodeData\n1\n\"u\"\n0\n0\n$EndNodeData\n";
  const auto file = read_gmsh_text(other + format_22 + physical + corner_nodes_22 + other + corner_elements_22 + data);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().mesh.nodes, corner);
}

TEST(GmshReader, ReadsElementsBeforeNodesAndDosLineEnds) {
  std::string text = format_22 + corner_elements_22 + corner_nodes_22;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, 1, '\r');
  const auto file = read_gmsh_text(text);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().mesh.nodes, corner);
}

TEST(GmshReader, SkipsTheParametersOfParametricNodes) {
  const auto file =
      read_gmsh_text(with(corner_41, "1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
                          "2 4 1 4\n2 1 1 2\n1\n2\n0 0 0 0.5 0.25\n1 0 0 0.5 0.75\n3 1 0 2\n3\n4\n0 1 0\n0 0 1\n"));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().mesh.nodes, corner);
}

TEST(GmshReader, RefusesOtherVersionsNamingThem) {
  for (const char* version : {"2.1", "4", "4.0", "3", "nan", "abc"}) {
    expect_refused(read_gmsh_text(with(corner_22, "2.2", version)), {"a.msh, line 2", version, "2.2 and 4.1"});
  }
  expect_refused(read_gmsh_text("$NOD\n4\n"), {"a.msh, line 1", "version 1", "2.2 and 4.1"});
}

TEST(GmshReader, RefusesOtherFileTypesAndDataSizes) {
  expect_refused(read_gmsh_text(with(corner_22, "2.2 0 8", "2.2 2 8")), {"line 2", "file type 2", "0 (ASCII)"});
  expect_refused(read_gmsh_text(with(corner_22, "2.2 0 8", "2.2 0 4")), {"line 2", "data size 4", "8"});
}

TEST(GmshReader, RefusesFilesThatAreNotGmshFiles) {
  expect_refused(read_gmsh_text("solid cube\n"), {"a.msh, line 1", "'solid'"});
  expect_refused(read_gmsh_text(""), {"a.msh", "$MeshFormat"});
  expect_refused(read_gmsh_text(std::string("\x7f"
                                            "ELF\n\0\0",
                                            7)),
                 {"a.msh, line 1", "'?ELF'"});
}

TEST(GmshReader, RefusesMissingAndRepeatedSections) {
  expect_refused(read_gmsh_text(format_22 + corner_elements_22), {"a.msh", "no $Nodes"});
  expect_refused(read_gmsh_text(format_22 + corner_nodes_22), {"a.msh", "no $Elements"});
  expect_refused(read_gmsh_text(corner_nodes_22), {"line 1", "$Nodes", "before $MeshFormat"});
  expect_refused(read_gmsh_text(corner_22 + corner_nodes_22), {"line 15", "second $Nodes"});
  expect_refused(read_gmsh_text(corner_22 + corner_elements_22), {"line 15", "second $Elements"});
  expect_refused(read_gmsh_text(corner_22 + format_22), {"line 15", "second $MeshFormat"});
  expect_refused(read_gmsh_text(corner_22 + "$Comments\nendless\n"), {"$EndComments"});
  expect_refused(read_gmsh_text(with(corner_22, "$EndNodes\n", "")), {"line 10", "$EndNodes", "'$Elements'"});
  expect_refused(read_gmsh_text(format_22 + "$ParametricNodes\n"), {"line 4", "parametric nodes"});
}

TEST(GmshReader, RefusesVolumeElementsOtherThanTetrahedraByName) {
  const std::string text = format_22 + corner_nodes_22 + "$Elements\n1\n";
  expect_refused(read_gmsh_text(text + "17 5 2 0 1 1 2 3 4 5 6 7 8\n$EndElements\n"),
                 {"a.msh, line 13", "element 17", "8-node hexahedron", "4-node tetrahedron"});
  expect_refused(read_gmsh_text(text + "18 11 2 0 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n"),
                 {"element 18", "10-node tetrahedron"});
  expect_refused(read_gmsh_text(text + "19 6 2 0 1 1 2 3 4 5 6\n$EndElements\n"), {"element 19", "6-node prism"});
  expect_refused(read_gmsh_text(text + "20 7 2 0 1 1 2 3 4 5\n$EndElements\n"), {"element 20", "5-node pyramid"});
  expect_refused(read_gmsh_text(text + "21 777 2 0 1 1\n$EndElements\n"), {"line 13", "777"});
}

TEST(GmshReader, RefusesASurfaceWhereAVolumeIsNeeded) {
  const std::string elements = "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n";
  expect_refused(read_gmsh_text(format_22 + corner_nodes_22 + elements),
                 {"a.msh", "a surface where a volume is needed"});
}

TEST(GmshReader, RefusesWordsWhereNumbersAreExpectedNamingTheLine) {
  expect_refused(read_gmsh_text(with(corner_22, "3 0 1 0", "3 0 one 0")), {"a.msh, line 8", "'one'", "coordinate"});
  expect_refused(read_gmsh_text(with(corner_22, "3 0 1 0", "3.5 0 1 0")), {"line 8", "'3.5'", "node number"});
  expect_refused(read_gmsh_text(with(corner_22, "1 2 3 4", "1 2 3 x4")), {"line 13", "'x4'", "node number"});
  expect_refused(read_gmsh_text(with(corner_22, "0 1 0", "0 1e999 0")), {"line 8", "'1e999'"});
  expect_refused(read_gmsh_text(with(corner_22, "0 1 0", "0 " + std::string(1000, 'x') + " 0")), {"xxx...'"});
}

TEST(GmshReader, RefusesCoordinatesThatAreNotFinite) {
  expect_refused(read_gmsh_text(with(corner_22, "3 0 1 0", "3 0 nan 0")), {"a.msh", "finite", "node 3"});
  expect_refused(read_gmsh_text(with(corner_41, "0 1 0", "0 -inf 0")), {"a.msh", "finite", "node 3"});
}

TEST(GmshReader, RefusesCountsThatTheFileCannotHold) {
  expect_refused(read_gmsh_text(with(corner_22, "$Nodes\n4", "$Nodes\n1000000000000")),
                 {"a.msh, line 5", "1000000000000 nodes"});
  expect_refused(read_gmsh_text(with(corner_22, "$Elements\n1", "$Elements\n9000000000000000000")),
                 {"line 12", "9000000000000000000 elements"});
  expect_refused(read_gmsh_text(with(corner_41, "1 4 1 4", "1 4000000000 1 4")), {"4000000000 nodes"});
  expect_refused(read_gmsh_text(with(corner_41, "1 1 1 1", "1 4000000000 1 1")), {"4000000000 elements"});
  expect_refused(read_gmsh_text(with(corner_22, "1 4 2 0 1", "1 4 2000000000 0 1")), {"line 13", "2000000000 tags"});
}

TEST(GmshReader, RefusesNegativeCounts) {
  expect_refused(read_gmsh_text(with(corner_22, "$Nodes\n4", "$Nodes\n-4")), {"line 5", "-4 nodes"});
  expect_refused(read_gmsh_text(with(corner_22, "$Elements\n1", "$Elements\n-1")), {"line 12", "-1 elements"});
  expect_refused(read_gmsh_text(with(corner_22, "1 4 2 0 1", "1 4 -2 0 1")), {"line 13", "-2 tags"});
  expect_refused(read_gmsh_text(with(corner_41, "3 1 0 4", "3 1 0 -4")), {"-4 nodes"});
}

TEST(GmshReader, RefusesBlocksThatDoNotAddUp) {
  expect_refused(read_gmsh_text(with(corner_41, "1 4 1 4", "1 3 1 4")), {"4 nodes", "0 to 3"});
  expect_refused(read_gmsh_text(with(corner_41, "1 4 1 4", "1 5 1 4")), {"1 nodes less than the 5"});
  expect_refused(read_gmsh_text(with(corner_41, "1 1 1 1", "0 1 1 1")), {"1 elements less than the 1"});
  expect_refused(read_gmsh_text(with(corner_41, "3 1 0 4", "7 1 0 4")), {"dimension 7"});
}

TEST(GmshReader, RefusesTruncatedAsciiFilesNamingTheFile) {
  const std::size_t element = corner_22.find("3 4\n$EndElements");
  expect_refused(read_gmsh_text(corner_22.substr(0, element)), {"a.msh, line 13", "the file ends", "node number"});
  expect_refused(read_gmsh_text(corner_22.substr(0, corner_22.find("3 0 1 0"))), {"a.msh, line 5", "cut short"});
  expect_refused(read_gmsh_text(corner_22.substr(0, corner_22.find("$EndElements"))), {"a.msh", "$EndElements"});
}

TEST(GmshReader, RefusesTruncatedBinaryFilesNamingTheFile) {
  for (const char* name : {"cube_22_binary.msh", "cube_41_binary.msh"}) {
    FileContent file = data_file(name);
    file.bytes.resize(file.bytes.size() - 20);
    expect_refused(read_gmsh_file(file), {name, "byte", "the file ends"});
  }
}

TEST(GmshReader, RefusesBinaryFilesOfTheOtherByteOrder) {
  for (const char* name : {"cube_22_binary.msh", "cube_41_binary.msh"}) {
    FileContent file = data_file(name);
    const std::size_t mark = file.bytes.find("1 8\n") + 4;
    ASSERT_EQ(file.bytes[mark], 1);
    std::swap(file.bytes[mark], file.bytes[mark + 3]);
    expect_refused(read_gmsh_file(file), {name, "other byte order"});
    file.bytes[mark] = 5;
    expect_refused(read_gmsh_file(file), {name, "byte order mark"});
  }
}

}  // namespace
}  // namespace flexcast
