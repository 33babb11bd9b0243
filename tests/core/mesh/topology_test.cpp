#include "core/mesh/topology.h"

#include <gtest/gtest.h>

#include "core/mesh/generators.h"

namespace flexcast {
namespace {

const std::vector<Vec3> corner_nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};

TEST(Topology, SixVolumesAreSignedByOrientation) {
  EXPECT_EQ(calc_six_volumes(corner_nodes, {0, 1, 2, 3}), 1.0);
  EXPECT_EQ(calc_six_volumes(corner_nodes, {0, 1, 3, 2}), -1.0);
}

TEST(Topology, OneTetrahedronHasFourOutwardFacesAndSixEdges) {
  const std::vector<Tetrahedron> one = {{0, 1, 2, 3}};
  EXPECT_EQ(make_boundary_triangles(one), (std::vector<Triangle>{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}));
  EXPECT_EQ(make_edges(one), (std::vector<Spring>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
}

TEST(Topology, ASharedFaceIsNotBoundary) {
  // Both tetrahedra have the face 1 2 3, each with its own order of the vertices.
  const auto triangles = make_boundary_triangles({{0, 1, 2, 3}, {4, 3, 2, 1}});
  EXPECT_EQ(triangles, (std::vector<Triangle>{{0, 3, 2}, {0, 1, 3}, {0, 2, 1}, {4, 1, 2}, {4, 3, 1}, {4, 2, 3}}));
}

TEST(Topology, EdgesSharedByElementsAppearOnce) {
  // V - E + F - C = 1 for a ball: 60 nodes, F = (4 * 144 + boundary) / 2.
  const Mesh beam = make_beam({2, 3, 4}, {1.0, 1.0, 1.0});
  const auto edges = make_edges(beam.tetrahedra);
  const int faces = static_cast<int>(4 * beam.tetrahedra.size() + beam.triangles.size()) / 2;
  EXPECT_EQ(static_cast<int>(beam.nodes.size()) - static_cast<int>(edges.size()) + faces -
                static_cast<int>(beam.tetrahedra.size()),
            1);
  EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
}

TEST(Topology, NothingFollowsFromNothing) {
  EXPECT_TRUE(make_boundary_triangles({}).empty());
  EXPECT_TRUE(make_edges({}).empty());
}

}  // namespace
}  // namespace flexcast
