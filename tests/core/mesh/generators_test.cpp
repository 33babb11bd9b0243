#include "core/mesh/generators.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <set>

#include "core/mesh/topology.h"

namespace flexcast {
namespace {

double calc_length(const Mesh& mesh, const Spring& spring) {
  return (mesh.nodes[spring[1]] - mesh.nodes[spring[0]]).norm();
}

void expect_springs_are_ordered_and_unique(const Mesh& mesh) {
  std::set<Spring> seen;
  for (const Spring& spring : mesh.springs) {
    EXPECT_LT(spring[0], spring[1]);
    EXPECT_TRUE(seen.insert(spring).second) << spring[0] << " " << spring[1];
  }
}

// Six times the volume inside a closed surface with outward normals.
double calc_enclosed_six_volumes(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) sum += mesh.nodes[a].dot(mesh.nodes[b].cross(mesh.nodes[c]));
  return sum;
}

TEST(Rope, HasASpringBetweenEachTwoNeighbours) {
  const Mesh rope = make_rope(4, 2.0);
  ASSERT_EQ(rope.nodes.size(), 5u);
  EXPECT_EQ(rope.springs, (std::vector<Spring>{{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  EXPECT_EQ(rope.nodes[1], Vec3(0.5, 0.0, 0.0));
  EXPECT_EQ(rope.nodes[4], Vec3(2.0, 0.0, 0.0));
  EXPECT_TRUE(rope.tetrahedra.empty());
  EXPECT_TRUE(rope.triangles.empty());
}

TEST(Rope, EndsExactlyAtItsLength) {
  for (int cells = 1; cells < 200; ++cells) EXPECT_EQ(make_rope(cells, 0.7).nodes.back().x(), 0.7) << cells;
}

TEST(Grid, NumbersNodesAlongXFirst) {
  const Mesh grid = make_grid({3, 2}, {3.0, 4.0});
  ASSERT_EQ(grid.nodes.size(), 12u);
  EXPECT_EQ(grid.nodes[2], Vec3(2.0, 0.0, 0.0));
  EXPECT_EQ(grid.nodes[4], Vec3(0.0, 2.0, 0.0));
  EXPECT_EQ(grid.nodes[11], Vec3(3.0, 4.0, 0.0));
}

TEST(Grid, HasStructuralShearAndBendSpringsOnce) {
  for (const auto& [nx, ny] : {std::pair(1, 1), std::pair(2, 1), std::pair(1, 3), std::pair(5, 4), std::pair(2, 2)}) {
    const Mesh grid = make_grid({nx, ny}, {1.0 * nx, 1.0 * ny});
    const int structural = nx * (ny + 1) + ny * (nx + 1);
    const int shear = 2 * nx * ny;
    const int bend = (nx - 1) * (ny + 1) + (ny - 1) * (nx + 1);
    std::map<double, int> count_by_length;
    for (const Spring& spring : grid.springs) ++count_by_length[std::round(1e6 * calc_length(grid, spring))];
    EXPECT_EQ(count_by_length[1000000.0], structural);
    EXPECT_EQ(count_by_length[1414214.0], shear);
    EXPECT_EQ(count_by_length[2000000.0], bend);
    EXPECT_EQ(grid.springs.size(), static_cast<std::size_t>(structural + shear + bend));
    expect_springs_are_ordered_and_unique(grid);
  }
}

TEST(Grid, BendSpringsRunAlongTheAxes) {
  const Mesh grid = make_grid({4, 4}, {4.0, 4.0});
  for (const Spring& spring : grid.springs) {
    const Vec3 d = grid.nodes[spring[1]] - grid.nodes[spring[0]];
    if (d.norm() > 1.9) {
      EXPECT_EQ(d.x() * d.y(), 0.0);
    }
  }
}

TEST(Grid, CoversItsAreaWithTwoTrianglesACellFacingUp) {
  const Mesh grid = make_grid({3, 2}, {3.0, 4.0});
  EXPECT_EQ(grid.triangles.size(), 12u);
  for (const auto& [a, b, c] : grid.triangles) {
    const Vec3 twice_area = (grid.nodes[b] - grid.nodes[a]).cross(grid.nodes[c] - grid.nodes[a]);
    EXPECT_DOUBLE_EQ(twice_area.z(), 2.0);
  }
}

TEST(Lattice, HasEdgesFaceDiagonalsAndBodyDiagonalsOnce) {
  for (const auto& [nx, ny, nz] : {std::tuple(1, 1, 1), std::tuple(2, 3, 4), std::tuple(1, 5, 1)}) {
    const Mesh lattice = make_lattice({nx, ny, nz}, {1.0 * nx, 1.0 * ny, 1.0 * nz});
    const int edges = nx * (ny + 1) * (nz + 1) + (nx + 1) * ny * (nz + 1) + (nx + 1) * (ny + 1) * nz;
    const int face_diagonals = 2 * (nx * ny * (nz + 1) + nx * (ny + 1) * nz + (nx + 1) * ny * nz);
    const int body_diagonals = 4 * nx * ny * nz;
    std::map<double, int> count_by_square;
    for (const Spring& spring : lattice.springs)
      ++count_by_square[std::round(std::pow(calc_length(lattice, spring), 2))];
    EXPECT_EQ(count_by_square[1.0], edges);
    EXPECT_EQ(count_by_square[2.0], face_diagonals);
    EXPECT_EQ(count_by_square[3.0], body_diagonals);
    EXPECT_EQ(lattice.springs.size(), static_cast<std::size_t>(edges + face_diagonals + body_diagonals));
    expect_springs_are_ordered_and_unique(lattice);
  }
}

TEST(Lattice, HasTheOutwardSurfaceOfTheBlockAndNoTetrahedra) {
  const Mesh lattice = make_lattice({2, 3, 4}, {1.0, 2.0, 3.0});
  EXPECT_TRUE(lattice.tetrahedra.empty());
  EXPECT_EQ(lattice.triangles.size(), 4u * (2 * 3 + 3 * 4 + 2 * 4));
  EXPECT_NEAR(calc_enclosed_six_volumes(lattice), 36.0, 1e-12);
}

TEST(Beam, UnitCellIsTheSixKuhnTetrahedra) {
  // Corners 0 to 7 by x + 2 y + 4 z; permutations xyz, xzy, yxz, yzx, zxy, zyx; odd ones with the last two swapped.
  const Mesh beam = make_beam({1, 1, 1}, {1.0, 1.0, 1.0});
  EXPECT_EQ(beam.tetrahedra, (std::vector<Tetrahedron>{
                                 {0, 1, 3, 7}, {0, 1, 7, 5}, {0, 2, 7, 3}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 7, 6}}));
  EXPECT_TRUE(beam.springs.empty());
}

TEST(Beam, NumbersNodesAlongXThenYThenZ) {
  const Mesh beam = make_beam({2, 3, 4}, {2.0, 3.0, 4.0});
  ASSERT_EQ(beam.nodes.size(), 60u);
  for (int k = 0; k <= 4; ++k) {
    for (int j = 0; j <= 3; ++j) {
      for (int i = 0; i <= 2; ++i) EXPECT_EQ(beam.nodes[i + 3 * (j + 4 * k)], Vec3(i, j, k));
    }
  }
}

TEST(Beam, HasPositiveVolumesThatFillTheBox) {
  const Mesh beam = make_beam({3, 2, 4}, {0.3, 0.5, 0.7});
  ASSERT_EQ(beam.tetrahedra.size(), 6u * 24u);
  double sum = 0.0;
  for (const Tetrahedron& tetrahedron : beam.tetrahedra) {
    const double six_volumes = calc_six_volumes(beam.nodes, tetrahedron);
    EXPECT_NEAR(six_volumes, 0.1 * 0.25 * 0.175, 1e-15);
    sum += six_volumes / 6.0;
  }
  EXPECT_NEAR(sum, 0.3 * 0.5 * 0.7, 1e-15);
}

TEST(Beam, IsConforming) {
  // With every inner face shared by two elements, only the box's faces are left: two triangles a cell face.
  const Mesh beam = make_beam({3, 2, 4}, {0.3, 0.5, 0.7});
  EXPECT_EQ(beam.triangles.size(), 4u * (3 * 2 + 2 * 4 + 3 * 4));
  for (const auto& [a, b, c] : beam.triangles) {
    bool on_one_side = false;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = beam.nodes[a][axis];
      const bool outer = x == 0.0 || x == Vec3(0.3, 0.5, 0.7)[axis];
      on_one_side |= outer && beam.nodes[b][axis] == x && beam.nodes[c][axis] == x;
    }
    EXPECT_TRUE(on_one_side);
  }
}

TEST(Beam, BoundaryNormalsPointOutward) {
  const Mesh beam = make_beam({3, 2, 4}, {0.3, 0.5, 0.7});
  const Vec3 centre(0.15, 0.25, 0.35);
  for (const auto& [a, b, c] : beam.triangles) {
    const Vec3 normal = (beam.nodes[b] - beam.nodes[a]).cross(beam.nodes[c] - beam.nodes[a]);
    EXPECT_GT(normal.dot(beam.nodes[a] - centre), 0.0);
  }
  EXPECT_NEAR(calc_enclosed_six_volumes(beam), 6 * 0.3 * 0.5 * 0.7, 1e-14);
}

}  // namespace
}  // namespace flexcast
