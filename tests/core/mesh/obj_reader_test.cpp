#include "core/mesh/obj_reader.h"

#include <gtest/gtest.h>

#include <set>

#include "core/mesh/generators.h"
#include "tests/core/mesh/mesh_texts.h"

namespace flexcast {
namespace {

using namespace mesh_texts;

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Mesh mesh_of(const std::string& text) {
  const auto file = read_obj_text(text);
  EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().message) << "\n" << text;
  return file.ok() ? file.value().mesh : Mesh{};
}

std::set<Spring> springs_of(const Mesh& mesh) {
  return {mesh.springs.begin(), mesh.springs.end()};
}

// Rows and columns of quadrangles, as modelling programs write a sheet.
std::string sheet_text(int nx, int ny) {
  std::string text = "# a sheet\no sheet\n";
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) text += "v " + std::to_string(i) + " " + std::to_string(j) + " 0\n";
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int corner = 1 + i + (nx + 1) * j;
      text += "f";
      for (const int node : {corner, corner + 1, corner + nx + 2, corner + nx + 1}) text += " " + std::to_string(node);
      text += "\n";
    }
  }
  return text;
}

TEST(ObjReader, QuadranglesInRowsAndColumnsAreTheGridOfTheGenerator) {
  const Mesh read = mesh_of(sheet_text(4, 3));
  const Mesh made = make_grid({4, 3}, {4.0, 3.0});
  EXPECT_EQ(read.nodes, made.nodes);
  EXPECT_EQ(springs_of(read), springs_of(made));
  EXPECT_EQ(read.springs.size(), made.springs.size()) << "each pair once";
  EXPECT_EQ(read.triangles, made.triangles);
  EXPECT_TRUE(read.tetrahedra.empty());
}

TEST(ObjReader, TwoTrianglesHaveTheirEdgesAndOneBendSpringAcrossTheInnerOne) {
  const Mesh mesh = mesh_of(corners + "f 1 2 3\nf 1 3 4\n");
  EXPECT_EQ(springs_of(mesh), (std::set<Spring>{{0, 1}, {1, 2}, {0, 2}, {2, 3}, {0, 3}, {1, 3}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ObjReader, AStripOfTrianglesBendsAcrossEveryInnerEdge) {
  const Mesh mesh = mesh_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 2 0\nf 1 2 3\nf 2 4 3\nf 3 4 5\n");
  EXPECT_EQ(mesh.springs.size(), 7u + 2u);
  EXPECT_TRUE(springs_of(mesh).contains(Spring{0, 3}));
  EXPECT_TRUE(springs_of(mesh).contains(Spring{1, 4}));
}

TEST(ObjReader, ThreeFacesAtOneEdgeBendAgainstEachOther) {
  const Mesh mesh = mesh_of("v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  EXPECT_EQ(mesh.springs.size(), 1u + 6u + 3u);
}

TEST(ObjReader, APentagonIsRigidInItsPlaneAndCoveredByTriangles) {
  const Mesh mesh = mesh_of("v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 2 0\nv -1 1 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(mesh.springs.size(), 10u);  // every two of five nodes
  EXPECT_EQ(mesh.triangles.size(), 3u);
}

// The fan about the first corner would fold over the bay.
TEST(ObjReader, AFaceWithABayIsCoveredOnce) {
  const Mesh mesh = mesh_of("v 1 0 0\nv 4 0 0\nv 4 1 0\nv 2 0.2 0\nv 0 3 0\nf 1 2 3 4 5\n");
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 normal = (mesh.nodes[b] - mesh.nodes[a]).cross(mesh.nodes[c] - mesh.nodes[a]);
    EXPECT_GT(normal.z(), 0.0);
    area += normal.z() / 2.0;
  }
  EXPECT_NEAR(area, 2.9, 1e-12);
}

TEST(ObjReader, EveryFormOfACornerNamesTheSameNodes) {
  const std::string rest = "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n";
  const Mesh plain = mesh_of(corners + rest + "f 1 2 3\nf 1 3 4\n");
  for (const std::string faces : {"f 1/1 2/2 3/3\nf 1/1 3/3 4/2\n", "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n",
                                  "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/2/1\n", "f -4 -3 -2\nf -4 -2 -1\n",
                                  "f -4//-1 -3//-1 -2//-1\nf 1 -2/-1 4\n"}) {
    EXPECT_EQ(mesh_of(corners + rest + faces).triangles, plain.triangles) << faces;
  }
}

TEST(ObjReader, NegativeNumbersCountFromTheLastVertexSoFar) {
  const Mesh mesh = mesh_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -4 -2 -1\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ObjReader, FacesMayStandBeforeTheirVerticesAndLinesMayGoOn) {
  const Mesh mesh = mesh_of("f 1 2 \\\n  3 \\\n 4\n" + corners);
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(ObjReader, WhatIsNoShapeIsIgnored) {
  const Mesh mesh = mesh_of(
      "mtllib a.mtl\r\no sheet\r\ng left\r\nusemtl red\r\ns off\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\n"
      "v 1 1 0 # here\r\nl 1 2\r\np 1\r\nf 1 2 3\r\n");
  EXPECT_EQ(mesh.nodes.size(), 3u);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(ObjReader, MalformedLinesAreNamed) {
  expect_refused(read_obj_text("v 0 0\n"), {"a.obj, line 1", "the line ends", "coordinate"});
  expect_refused(read_obj_text("v 0 0 x\n"), {"line 1", "'x'", "coordinate"});
  expect_refused(read_obj_text("v 0 0 0 1 2 3 4 5\n"), {"line 1", "'5'", "end of a vertex"});
  expect_refused(read_obj_text(corners + "f 1 2\n"), {"line 5", "2 corners", "3 are needed"});
  expect_refused(read_obj_text(corners + "f 1 2 0\n"), {"line 5", "node 0"});
  expect_refused(read_obj_text(corners + "f 1 2 3/\n"), {"line 5", "'3/'", "7//1"});
  expect_refused(read_obj_text(corners + "f 1 2 3/1/\n"), {"line 5", "'3/1/'"});
  expect_refused(read_obj_text(corners + "f 1 2 a\n"), {"line 5", "'a'"});
  expect_refused(read_obj_text("vertex 0 0 0\n"), {"line 1", "'vertex'", "Wavefront"});
  expect_refused(read_obj_text("cstype bezier\n"), {"line 1", "free-form", "'cstype'"});
}

TEST(ObjReader, BadSurfacesAreRefusedNamingTheFirstOffendersAndTheirCount) {
  expect_refused(read_obj_text(""), {"a.obj", "has no nodes"});
  expect_refused(read_obj_text(corners), {"has no faces"});
  expect_refused(read_obj_text(corners + "f 1 2 5\nf 1 2 -7\nf 2 3 4\n"),
                 {"do not exist", "1 to 4", "in line 5 (node 5)", "in line 6 (node -2)"});
  expect_refused(read_obj_text(corners + "f 1 2 1 3\n"), {"same node twice", "in line 5 (node 1)"});
  expect_refused(read_obj_text(corners + "f 1 2 3 4\nf 3 4 1 2\n"),
                 {"nodes of another face", "in line 6 (as in line 5)"});
  expect_refused(read_obj_text(corners + "f 1 2 3\n"), {"belong to no face", "node 4"});
  expect_refused(read_obj_text(corners + "v 0 0 0\nf 1 2 3 4\nf 5 2 3\n"), {"same place", "5 (as 1)"});
  expect_refused(read_obj_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), {"no area", "in line 4"});
  expect_refused(read_obj_text("v 0 0 0\nv nan 0 0\nv 2 0 0\nf 1 2 3\n"), {"not finite", "node 2"});
  std::string many = "v 0 0 0\n";
  for (int i = 0; i < 28; ++i) many += "f 7 8 9\n";
  expect_refused(read_obj_text(many), {"... (84 in all)"});
  std::string fan = "v 0 0 0\nv 0 0 1\n";
  for (int i = 0; i < 65; ++i) fan += "v 1 " + std::to_string(i) + " 0\nf 1 2 -1\n";
  expect_refused(read_obj_text(fan), {"more than 64 faces", "1-2"});
}

}  // namespace
}  // namespace flexcast
