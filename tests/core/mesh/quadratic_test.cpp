#include "core/mesh/quadratic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/mesh/generators.h"
#include "core/mesh/topology.h"

namespace flexcast {
namespace {

TEST(Quadratic, MidsideNodesOfOneTetrahedronFollowItsSortedEdges) {
  Mesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {{0, 2, 3, 1}}, {}, {}};
  mesh.triangles = make_boundary_triangles(mesh.tetrahedra);
  const std::vector<Midsides> midsides = make_quadratic(mesh);
  // Sorted edges 01 02 03 12 13 23 are the nodes 4 to 9; local edges are 02 03 01 23 21 31.
  EXPECT_EQ(midsides, (std::vector<Midsides>{{5, 6, 4, 9, 7, 8}}));
  const std::vector<Vec3> expected = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}};
  EXPECT_EQ(std::vector<Vec3>(mesh.nodes.begin() + 4, mesh.nodes.end()), expected);
  EXPECT_EQ(mesh.tetrahedra, (std::vector<Tetrahedron>{{0, 2, 3, 1}}));
}

TEST(Quadratic, NeighboursShareTheNodeOfTheirEdgeAndItLiesAmidIt) {
  Mesh mesh = make_beam({3, 2, 2}, {3.0, 1.0, 1.0});
  const std::size_t corners = mesh.nodes.size();
  const auto edges = make_edges(mesh.tetrahedra);
  const std::vector<Midsides> midsides = make_quadratic(mesh);
  ASSERT_EQ(mesh.nodes.size(), corners + edges.size());
  for (std::size_t t = 0; t < midsides.size(); ++t) {
    for (std::size_t e = 0; e < 6; ++e) {
      const std::int32_t a = mesh.tetrahedra[t][local_edges[e][0]], b = mesh.tetrahedra[t][local_edges[e][1]];
      const auto edge = edges[midsides[t][e] - corners];
      EXPECT_EQ(edge, (Spring{std::min(a, b), std::max(a, b)}));
      EXPECT_EQ(mesh.nodes[midsides[t][e]], 0.5 * (mesh.nodes[a] + mesh.nodes[b]));
    }
  }
}

TEST(Quadratic, SurfaceStaysClosedOutwardAndOfTheSameArea) {
  Mesh mesh = make_beam({3, 2, 2}, {3.0, 1.0, 1.0});
  const std::size_t linear = mesh.triangles.size();
  make_quadratic(mesh);
  ASSERT_EQ(mesh.triangles.size(), 4 * linear);
  std::map<std::pair<int, int>, int> directed;
  double area = 0.0, six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& side : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++directed[side];
    area += 0.5 * (mesh.nodes[b] - mesh.nodes[a]).cross(mesh.nodes[c] - mesh.nodes[a]).norm();
    six_volumes += mesh.nodes[a].dot(mesh.nodes[b].cross(mesh.nodes[c]));
  }
  for (const auto& [side, count] : directed) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(directed.contains({side.second, side.first}));
  }
  EXPECT_NEAR(area, 14.0, 1e-12);
  EXPECT_NEAR(six_volumes, 18.0, 1e-12);
}

}  // namespace
}  // namespace flexcast
