#include "core/mesh/tetgen_reader.h"

#include <gtest/gtest.h>

#include "tests/core/mesh/mesh_texts.h"

namespace flexcast {
namespace {

using namespace mesh_texts;

Result<MeshFile> read_pair(const std::string& name) {
  const auto numbered = parse_tetgen(data_file(name + ".node"), data_file(name + ".ele"));
  return numbered ? check_mesh(numbered.value()) : numbered.error();
}

TEST(TetgenReader, ReadsTheCubeWithAttributesAndMarkers) {
  const auto file = read_pair("cube_from_1");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().mesh.nodes.size(), 8u);
  EXPECT_EQ(file.value().mesh.nodes[6], Vec3(1, 1, 1));
  EXPECT_EQ(file.value().mesh.tetrahedra.size(), 6u);
  EXPECT_EQ(file.value().mesh.tetrahedra[0], (Tetrahedron{0, 3, 7, 2}));
  EXPECT_EQ(file.value().mesh.triangles.size(), 12u);
  EXPECT_TRUE(file.value().repairs.empty());
}

TEST(TetgenReader, NumberingFrom0And1GivesTheSameMesh) {
  const auto from_0 = read_pair("cube_from_0");
  const auto from_1 = read_pair("cube_from_1");
  ASSERT_TRUE(from_0.ok() && from_1.ok());
  EXPECT_EQ(from_0.value().mesh.nodes, from_1.value().mesh.nodes);
  EXPECT_EQ(from_0.value().mesh.tetrahedra, from_1.value().mesh.tetrahedra);
}

TEST(TetgenReader, IgnoresCommentsBlankLinesAndFurtherColumns) {
  const auto file = read_tetgen_text(
      "# a corner\n\n4 3 1 1  # header\n 1 0 0 0 0.5 7\n2 1 0 0 0.5 7\r\n\t3 0 1 0 0.5 7\n"
      "#3 9 9 9\n4 0 0 1 0.5 7",
      "1\n1 1 2 3 4 # an element\n# the end");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().mesh.nodes[3], Vec3(0, 0, 1));
  EXPECT_EQ(file.value().mesh.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
}

TEST(TetgenReader, RefusesOtherThan4NodesPerElementByName) {
  expect_refused(read_tetgen_text(corner_node, "1 10 0\n1 1 2 3 4 5 6 7 8 9 10\n"),
                 {"a.ele, line 1", "10-node tetrahedra", "4-node"});
  expect_refused(read_tetgen_text(corner_node, "1 8 0\n1 1 2 3 4 5 6 7 8\n"), {"a.ele, line 1", "8 nodes per element"});
}

TEST(TetgenReader, RefusesNodesInThePlane) {
  expect_refused(read_tetgen_text("3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n", corner_ele),
                 {"a.node, line 1", "dimension 2", "3"});
}

TEST(TetgenReader, RefusesNumberingThatStartsElsewhereOrJumps) {
  expect_refused(read_tetgen_text(with(corner_node, "\n1 0", "\n2 0"), corner_ele), {"a.node, line 2", "2", "0 and 1"});
  expect_refused(read_tetgen_text(with(corner_node, "\n3 0", "\n7 0"), corner_ele),
                 {"a.node, line 4", "node 7", "node 3"});
}

TEST(TetgenReader, RefusesFilesThatEndEarlyOrLate) {
  expect_refused(read_tetgen_text(with(corner_node, "4 0 0 1\n", ""), corner_ele), {"a.node", "3 of 4 nodes"});
  expect_refused(read_tetgen_text(corner_node + "5 1 1 1\n", corner_ele), {"a.node, line 7", "more than the 4 nodes"});
  expect_refused(read_tetgen_text(corner_node, "2 4 0\n1 1 2 3 4\n# no more of them"), {"a.ele", "1 of 2 elements"});
  expect_refused(read_tetgen_text(corner_node, corner_ele + "2 1 2 3 4\n"),
                 {"a.ele, line 3", "more than the 1 elements"});
  expect_refused(read_tetgen_text("", corner_ele), {"a.node", "the file ends"});
  expect_refused(read_tetgen_text(corner_node, "# nothing\n"), {"a.ele", "the file ends"});
  expect_refused(read_tetgen_text(with(corner_node, "3 0 1 0", "3 0 1"), corner_ele),
                 {"a.node, line 4", "the line ends", "coordinate"});
}

TEST(TetgenReader, RefusesCountsThatTheFileCannotHold) {
  expect_refused(read_tetgen_text(with(corner_node, "4 3", "1000000000000 3"), corner_ele),
                 {"a.node, line 1", "1000000000000 nodes"});
  expect_refused(read_tetgen_text(corner_node, with(corner_ele, "1 4", "1000000000000 4")),
                 {"a.ele, line 1", "1000000000000 elements"});
  expect_refused(read_tetgen_text(with(corner_node, "4 3", "-4 3"), corner_ele), {"a.node, line 1", "-4 nodes"});
  expect_refused(read_tetgen_text(corner_node, with(corner_ele, "1 4", "-1 4")), {"a.ele, line 1", "-1 elements"});
}

TEST(TetgenReader, RefusesWordsWhereNumbersAreExpectedNamingTheLine) {
  expect_refused(read_tetgen_text(with(corner_node, "0 1 0", "0 one 0"), corner_ele), {"a.node, line 4", "'one'"});
  expect_refused(read_tetgen_text(corner_node, with(corner_ele, "3 4", "3.0 4")), {"a.ele, line 2", "'3.0'"});
  expect_refused(read_tetgen_text(with(corner_node, "0 1 0", "0 nan 0"), corner_ele), {"a.node", "finite", "node 3"});
}

TEST(TetgenReader, NamesTheElementFileForElementsAndTheNodeFileForNodes) {
  expect_refused(read_tetgen_text(corner_node, with(corner_ele, "3 4", "3 5")),
                 {"a.ele", "element 1 (node 5)", "1 to 4"});
  expect_refused(read_tetgen_text(with(corner_node, "4 0 0 1", "4 0 1 0"), corner_ele), {"a.node", "node 4 (as 3)"});
}

TEST(TetgenReader, RefusesFilesWithoutNodesOrElements) {
  expect_refused(read_tetgen_text("0 3 0 0\n", corner_ele), {"a.node", "no nodes"});
  expect_refused(read_tetgen_text(corner_node, "0 4 0\n"), {"a.ele", "a surface where a volume is needed"});
}

}  // namespace
}  // namespace flexcast
