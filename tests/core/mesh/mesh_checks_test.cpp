#include "core/mesh/mesh_checks.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numeric>

#include "core/mesh/generators.h"
#include "core/mesh/topology.h"
#include "tests/core/mesh/mesh_texts.h"

namespace flexcast {
namespace {

using mesh_texts::expect_refused;

// Nodes numbered from 1, elements from 101.
NumberedMesh make_numbered(std::vector<Vec3> nodes, std::vector<std::array<std::int64_t, 4>> elements) {
  NumberedMesh numbered{"a.node", "a.ele", std::move(nodes), {}, std::move(elements), {}};
  numbered.node_numbers.resize(numbered.nodes.size());
  numbered.element_numbers.resize(numbered.elements.size());
  std::iota(numbered.node_numbers.begin(), numbered.node_numbers.end(), 1);
  std::iota(numbered.element_numbers.begin(), numbered.element_numbers.end(), 101);
  return numbered;
}

NumberedMesh make_corner() {
  return make_numbered({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{1, 2, 3, 4}});
}

NumberedMesh make_numbered_beam() {
  const Mesh beam = make_beam({2, 2, 2}, {1.0, 1.0, 1.0});
  std::vector<std::array<std::int64_t, 4>> elements;
  for (const auto& [a, b, c, d] : beam.tetrahedra) elements.push_back({a + 1, b + 1, c + 1, d + 1});
  return make_numbered(beam.nodes, elements);
}

TEST(MeshChecks, AcceptsABeamUnchanged) {
  const auto file = check_mesh(make_numbered_beam());
  ASSERT_TRUE(file.ok()) << file.error().message;
  const Mesh beam = make_beam({2, 2, 2}, {1.0, 1.0, 1.0});
  EXPECT_EQ(file.value().mesh.nodes, beam.nodes);
  EXPECT_EQ(file.value().mesh.tetrahedra, beam.tetrahedra);
  EXPECT_EQ(file.value().mesh.triangles, beam.triangles);
  EXPECT_TRUE(file.value().repairs.empty());
}

TEST(MeshChecks, RefusesNodeNumbersOutOfRange) {
  NumberedMesh mesh = make_corner();
  for (std::int64_t wrong : {std::int64_t{0}, std::int64_t{5}, std::int64_t{-1}, std::int64_t{1} << 40}) {
    mesh.elements[0][2] = wrong;
    const std::string named = "element 101 (node " + std::to_string(wrong) + ")";
    expect_refused(check_mesh(mesh), {"a.ele: ", "do not exist", "1 to 4", named.c_str()});
  }
}

TEST(MeshChecks, RefusesANodeTwiceInAnElement) {
  NumberedMesh mesh = make_corner();
  mesh.elements[0] = {1, 2, 3, 2};
  expect_refused(check_mesh(mesh), {"a.ele: ", "twice", "element 101 (node 2)"});
}

TEST(MeshChecks, RefusesTheSameElementTwiceInAnyOrder) {
  NumberedMesh mesh = make_numbered_beam();
  mesh.elements.push_back({mesh.elements[3][2], mesh.elements[3][0], mesh.elements[3][3], mesh.elements[3][1]});
  mesh.element_numbers.push_back(999);
  expect_refused(check_mesh(mesh), {"a.ele: ", "element 999 (as 104)"});
}

TEST(MeshChecks, RefusesTwoNodesAtOnePlace) {
  NumberedMesh mesh = make_numbered_beam();
  mesh.nodes[8] = mesh.nodes[20];
  expect_refused(check_mesh(mesh), {"a.node: ", "same place", "node 21 (as 9)"});
  NumberedMesh zeros = make_corner();
  zeros.nodes[3] = Vec3(-0.0, 1.0, 0.0);
  expect_refused(check_mesh(zeros), {"node 4 (as 3)"});
}

TEST(MeshChecks, RefusesNodesThatBelongToNoTetrahedron) {
  NumberedMesh mesh = make_corner();
  mesh.nodes.emplace_back(2.0, 2.0, 2.0);
  mesh.node_numbers.push_back(77);
  expect_refused(check_mesh(mesh), {"a.node: ", "no tetrahedron", "node 77"});
}

TEST(MeshChecks, RefusesANumberGivenToTwoNodes) {
  NumberedMesh mesh = make_corner();
  mesh.node_numbers[1] = 4;
  expect_refused(check_mesh(mesh), {"a.node: ", "more than one node", "node 4"});
}

TEST(MeshChecks, RefusesCoordinatesThatAreNotFinite) {
  for (double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    NumberedMesh mesh = make_corner();
    mesh.nodes[2].z() = wrong;
    expect_refused(check_mesh(mesh), {"a.node: ", "finite", "node 3"});
  }
}

TEST(MeshChecks, RefusesFlatElementsOfAnySize) {
  for (double size : {1e-300, 1e-150, 1e-9, 1.0, 1e9, 1e150, 1e300}) {
    NumberedMesh mesh = make_corner();
    mesh.nodes[3] = Vec3(1.0, 1.0, 0.0);
    for (Vec3& node : mesh.nodes) node *= size;
    expect_refused(check_mesh(mesh), {"a.ele: ", "no volume", "element 101"});
  }
}

TEST(MeshChecks, AcceptsThinElementsOfAnySize) {
  for (double size : {1e-300, 1e-150, 1e-9, 1.0, 1e9, 1e150, 1e300}) {
    NumberedMesh mesh = make_corner();
    mesh.nodes[3] = Vec3(0.3, 0.3, 1e-6);
    for (Vec3& node : mesh.nodes) node *= size;
    const auto file = check_mesh(mesh);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_TRUE(file.value().repairs.empty());
  }
}

TEST(MeshChecks, RefusesFlatElementsInAnyPlane) {
  // Turned and far from the origin, the four points are coplanar up to the rounding of their coordinates only.
  for (int i = 1; i < 200; ++i) {
    const Mat3 turned = Eigen::AngleAxisd(0.1 * i, Vec3(1.0, 0.3 * i, 2.0).normalized()).toRotationMatrix();
    NumberedMesh mesh = make_corner();
    mesh.nodes[3] = Vec3(0.7, 0.9, 0.0);
    for (Vec3& node : mesh.nodes) node = turned * node + Vec3(1.0, 20.0, 1e5) * (i % 3);
    expect_refused(check_mesh(mesh), {"no volume"});
  }
}

TEST(MeshChecks, RefusesFourNodesInALine) {
  const Vec3 step(0.1, 0.2, 0.3);
  expect_refused(check_mesh(make_numbered({step, 2 * step, 3 * step, 5 * step}, {{1, 2, 3, 4}})), {"no volume"});
}

TEST(MeshChecks, TurnsInvertedElementsRoundAndReportsThem) {
  NumberedMesh mesh = make_numbered_beam();
  std::swap(mesh.elements[7][0], mesh.elements[7][1]);
  std::swap(mesh.elements[9][2], mesh.elements[9][3]);
  const auto file = check_mesh(mesh);
  ASSERT_TRUE(file.ok()) << file.error().message;
  for (const Tetrahedron& tetrahedron : file.value().mesh.tetrahedra) {
    EXPECT_GT(calc_six_volumes(file.value().mesh.nodes, tetrahedron), 0.0);
  }
  EXPECT_EQ(file.value().mesh.tetrahedra[7][3] + 1, mesh.elements[7][2]);  // the last two are swapped
  ASSERT_EQ(file.value().repairs.size(), 1u);
  EXPECT_NE(file.value().repairs[0].find("elements 108, 110"), std::string::npos) << file.value().repairs[0];
  EXPECT_NE(file.value().repairs[0].find("a.ele: "), std::string::npos);
}

TEST(MeshChecks, NamesTheFirstOffendersAndCountsAll) {
  NumberedMesh mesh = make_numbered_beam();
  for (auto& element : mesh.elements) std::swap(element[2], element[3]);
  const auto file = check_mesh(mesh);
  ASSERT_TRUE(file.ok());
  EXPECT_NE(file.value().repairs[0].find("elements 101, 102, 103, 104, 105, ... (48 in all)"), std::string::npos)
      << file.value().repairs[0];
}

TEST(MeshChecks, RefusesASurfaceWhereAVolumeIsNeeded) {
  expect_refused(check_mesh(make_numbered({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {})),
                 {"a.ele: ", "a surface where a volume is needed"});
}

}  // namespace
}  // namespace flexcast
